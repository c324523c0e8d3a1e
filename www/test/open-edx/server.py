"""
Open edX's block for SCORM packages, in a server of its own on loopback: `server.py PACKAGE.zip JQUERY.js FOLDER`. Prints
its address. `/` is the page of a course with the package, `/gradebook` what the learning system has, as JSON.
"""

import json
import sys
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from types import SimpleNamespace

import django
from django.conf import settings

package, jquery, folder = sys.argv[1:]
settings.configure(
    MEDIA_ROOT=folder,
    TEMPLATES=[{"BACKEND": "django.template.backends.django.DjangoTemplates"}],
    USE_I18N=False,
)
django.setup()

from openedxscorm.scormxblock import ScormXBlock  # noqa: E402
from webob import Request  # noqa: E402
from xblock.fields import ScopeIds  # noqa: E402
from xblock.runtime import DictKeyValueStore, KvsFieldData, Runtime  # noqa: E402

USER = SimpleNamespace(
    opt_attrs={
        "edx-platform.user_id": 7,
        "edx-platform.username": "ada",
        "edx-platform.is_authenticated": True,
    }
)
KEPT = KvsFieldData(DictKeyValueStore())
GRADES = []


class Course(Runtime):
    """A course with one block and one student."""

    def __init__(self):
        services = {
            "user": SimpleNamespace(get_current_user=lambda: USER),
            "settings": SimpleNamespace(get_settings_bucket=lambda _block: {}),
            "field-data": KEPT,
        }
        super().__init__(id_reader=None, id_generator=None, services=services)

    def block(self):
        block = ScormXBlock(self, scope_ids=ScopeIds("7", "scorm", "block", "block"))
        block.location = SimpleNamespace(block_id="block", org="o", course="c")
        return block

    def handler_url(self, block, handler_name, suffix="", query="", thirdparty=False):
        return f"/{handler_name}/{suffix}"

    def publish(self, block, event_type, event_data):
        if event_type == "grade":
            GRADES.append(event_data["value"] / event_data["max_value"])

    def resource_url(self, resource):
        return resource

    def local_resource_url(self, block, uri):
        return uri

    def get_block(self, usage_id, for_parent=None):
        return self.block()

    def parse_xml_file(self, fileobj):
        raise NotImplementedError


COURSE = Course()


def upload():
    """Gives the package to the block as its author does."""
    block = COURSE.block()
    with open(package, "rb") as file:
        fields = dict(display_name="Plants", width="", height="", has_score="1", weight="1", navigation_menu_width="")
        flags = dict.fromkeys(["enable_navigation_menu", "enable_fullscreen_button", "popup_on_launch"], "0")
        block.studio_submit(
            SimpleNamespace(method="POST", params={**fields, **flags, "file": SimpleNamespace(file=file)}), ""
        )
    block.save()


def page(block):
    """The block in a page, as the page of a course begins it."""
    fragment = block.student_view({})
    block.save()
    scripts = "".join(
        f"<script>{resource.data}</script>"
        for resource in fragment.resources
        if resource.mimetype == "application/javascript"
    )
    handlers = "{ handlerUrl: (element, name) => '/' + name + '/' }"
    begin = f"{fragment.js_init_fn}({handlers}, document.getElementById('block'), {json.dumps(fragment.json_init_args)})"
    return (
        '<!doctype html><meta charset="utf-8"><title>Course</title><script src="/jquery.js"></script>'
        f'<div id="block">{fragment.content}</div>{scripts}<script>{begin}</script>'
    )


class Handler(BaseHTTPRequestHandler):
    """Answers requests by the handlers of the block."""

    def answer(self, body, kind="text/html; charset=utf-8", status=200):
        self.send_response(status)
        self.send_header("Content-Type", kind or "application/octet-stream")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        # A browser that goes on elsewhere does not wait for the rest.
        with suppress(BrokenPipeError, ConnectionResetError):
            self.wfile.write(body)

    def respond(self):
        block = COURSE.block()
        name, _, suffix = self.path.lstrip("/").partition("/")
        if name == "":
            return self.answer(page(block).encode())
        if name == "jquery.js":
            return self.answer(Path(jquery).read_bytes(), "text/javascript")
        if name == "gradebook":
            fields = ["lesson_status", "success_status", "lesson_score", "scorm_data"]
            return self.answer(json.dumps({field: getattr(block, field) for field in fields} | {"grades": GRADES}).encode())
        if name not in ScormXBlock.__dict__:
            return self.answer(b"", status=404)
        request = Request.blank(self.path, method=self.command)
        request.body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        response = block.handle(name, request, suffix)
        block.save()
        return self.answer(response.body, response.headers.get("Content-Type"), response.status_int)

    do_GET = do_POST = respond

    def log_message(self, *_words):
        pass


upload()
server = HTTPServer(("127.0.0.1", 0), Handler)
print(f"http://127.0.0.1:{server.server_port}/", flush=True)
server.serve_forever()
