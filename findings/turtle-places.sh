#!/usr/bin/env bash
# Two packages draw with Python's turtle where there is no window: svg-turtle, and basthon-turtle of the French notebooks.
# Seen: installing basthon-turtle 0.4.1 beside svg-turtle 1.2.0 makes the latter fail at its import, since `import turtle` is then
# another module, which lacks RawTurtle. Screen.mainloop is missing there, and mainloop and done of the module are not.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check svg-turtle==1.2.0

cat >import.py <<'END'
import turtle

print("turtle is the one of", "Python" if "site-packages" not in turtle.__file__ else "a package")
try:
    import svg_turtle

    print("svg_turtle is imported")
except ImportError as error:
    print("svg_turtle:", str(error).split(" (")[0])
print("Screen.mainloop:", hasattr(turtle, "RawTurtle") or hasattr(turtle.Screen(), "mainloop"))
print("mainloop, done:", hasattr(turtle, "mainloop"), hasattr(turtle, "done"))
END
{
    python/bin/python import.py
    python/bin/pip install --quiet --disable-pip-version-check basthon-turtle==0.4.1
    python/bin/python import.py
} 2>/dev/null | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
turtle is the one of Python
svg_turtle is imported
Screen.mainloop: True
mainloop, done: True True
turtle is the one of a package
svg_turtle: cannot import name 'RawTurtle' from 'basthon.turtle'
Screen.mainloop: False
mainloop, done: True True
END
