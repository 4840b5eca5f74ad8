"""What the scripts share: a JSON list of [name, text] on the standard input; on the standard output the compiler's version, then
for each text its name, what the compiler said of it, and the result in base64, as JSON lines."""

import base64
import json
import os
import sys


def run(version, compile):
    """Runs `compile`, which takes a name and a text and returns what was said, and the result."""
    print(json.dumps(version))
    for name, text in json.load(sys.stdin):
        said, result = compile(name, text)
        print(json.dumps([name, said.strip(), base64.b64encode(result).decode()]), flush=True)
    # The libraries are not unloaded: not all of them can be.
    os._exit(0)
