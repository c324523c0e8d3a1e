#!/usr/bin/env bash
# A PDF of one page with an attached file. Programs that save it again keep the file; most of those that take its page into another
# document do not, and say nothing.
# Seen: pypdf 7.1.1 keeps it by clone_from, and loses it by append; PyMuPDF 2.0 keeps it by save, and loses it by insert_pdf; pikepdf
# 10.18.0 keeps it by save, and loses it where pages are added to a new document.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check pypdf==7.1.1 pymupdf==2.0 pikepdf==10.18.0

cat >save.py <<'END'
import pikepdf
import pymupdf
import pypdf

source = pypdf.PdfWriter()
source.add_blank_page(100, 100)
source.add_attachment("notes.json", b'{"a": 1}')
source.write("source.pdf")


def tell(what):
    print(f"{what}:", list(pypdf.PdfReader("copy.pdf").attachments))


pypdf.PdfWriter(clone_from="source.pdf").write("copy.pdf")
tell("pypdf clone_from")
joined = pypdf.PdfWriter()
joined.append("source.pdf")
joined.write("copy.pdf")
tell("pypdf append")
pymupdf.open("source.pdf").save("copy.pdf", garbage=4, deflate=True)
tell("PyMuPDF save")
joined = pymupdf.open()
joined.insert_pdf(pymupdf.open("source.pdf"))
joined.save("copy.pdf")
tell("PyMuPDF insert_pdf")
with pikepdf.open("source.pdf") as document:
    document.save("copy.pdf", object_stream_mode=pikepdf.ObjectStreamMode.generate)
    tell("pikepdf save")
    joined = pikepdf.new()
    joined.pages.extend(document.pages)
    joined.save("copy.pdf")
tell("pikepdf pages")
END
python/bin/python save.py | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
pypdf clone_from: ['notes.json']
pypdf append: []
PyMuPDF save: ['notes.json']
PyMuPDF insert_pdf: []
pikepdf save: ['notes.json']
pikepdf pages: []
END
