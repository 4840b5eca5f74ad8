#!/usr/bin/env python3
"""Opens the page in headless Chromium, and fails unless both APIs agree with the page's vectors and nothing complains.

usage: check.py [CHROMIUM [FOLDER OF ITS LIBRARIES...]]
"""

import http.server
import os
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
SECONDS = 120
# Chromium's own renderers for machines without a GPU.
FLAGS = [
    "--headless=new", "--no-sandbox", "--no-first-run", "--disable-extensions", "--enable-logging=stderr",
    "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
]  # fmt: skip
CONSOLE = re.compile(r'\[.*?(INFO|WARNING|ERROR):CONSOLE.*?\] "(.*)", source:')


class Files(http.server.SimpleHTTPRequestHandler):
    """The repository's files, without a line for each."""

    def __init__(self, *arguments):
        super().__init__(*arguments, directory=REPOSITORY)

    def log_message(self, *arguments):
        pass


def said(chromium, libraries, url, profile):
    """What the page writes to the console, by level, up to the line `done`."""
    environment = dict(os.environ, LD_LIBRARY_PATH=os.pathsep.join(libraries)) if libraries else None
    command = [chromium, *FLAGS, f"--user-data-dir={profile}", url]
    browser = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, errors="replace", env=environment)
    alarm = threading.Timer(SECONDS, browser.kill)
    alarm.start()
    lines = []
    for line in browser.stderr:
        match = CONSOLE.search(line)
        if match:
            lines.append(match.groups())
            if match[2] == "done":
                break
    alarm.cancel()
    browser.kill()
    browser.wait()
    return lines


def main():
    chromium, *libraries = sys.argv[1:] or ["chromium"]
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Files)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        url = f"http://127.0.0.1:{server.server_port}/examples/web/"
        lines = said(chromium, libraries, url, profile)
    for level, text in lines:
        print(f"{level}: {text}")
    verdicts = [text for _, text in lines]
    agreed = [re.search(r"^(WebGPU|WebGL 2): (\d+) of \2 agree to the bit$", text) for text in verdicts]
    complaints = [text for level, text in lines if level != "INFO"]
    if len([match for match in agreed if match]) != 2 or verdicts[-1:] != ["done"] or complaints:
        sys.exit("check.py: the page should run WebGPU and WebGL 2, agree with its vectors and complain of nothing")


main()
