#!/usr/bin/env python3
"""Opens a report in headless Chromium, and fails unless it says nothing, fits, shows every picture, filters and slides.

usage: browser.py [--screenshots FOLDER] [--choose JSON] [--hemisphere JSON] REPORT [CHROMIUM [FOLDER OF ITS LIBRARIES...]]

JSON is what `unitvec choose --max-error 0.1 --json -` says, and the same with --hemisphere: the page has to choose the same, and show
the same means.
"""

import argparse
import base64
import json
import os
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

SECONDS = 180
FLAGS = ["--headless=new", "--no-sandbox", "--no-first-run", "--disable-extensions", "--disable-gpu", "--remote-debugging-pipe"]
WIDTHS = {400: 860, 1600: 1000}
# What `choose` is asked for.
MAX_ERROR = "0.1"


class Page:
    """A page that is driven by the DevTools protocol, through a pair of pipes."""

    def __init__(self, chromium, libraries, profile):
        environment = dict(os.environ, LD_LIBRARY_PATH=os.pathsep.join(libraries)) if libraries else None
        to_read, self.to = os.pipe()
        self.source, from_write = os.pipe()

        def ends():
            # Chromium reads from 3 and writes to 4.
            copies = [os.dup(to_read), os.dup(from_write)]
            while min(copies) < 5:
                copies = [os.dup(copy) for copy in copies]
            os.dup2(copies[0], 3)
            os.dup2(copies[1], 4)

        command = [chromium, *FLAGS, f"--user-data-dir={profile}", "about:blank"]
        self.browser = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment, close_fds=False, preexec_fn=ends
        )
        os.close(to_read)
        os.close(from_write)
        self.alarm = threading.Timer(SECONDS, self.browser.kill)
        self.alarm.start()
        self.rest, self.last, self.session, self.said = b"", 0, None, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log", "Network"]:
            self.call(f"{domain}.enable")

    def call(self, method, **parameters):
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") == self.last:
                if "error" in answer:
                    sys.exit(f"browser.py: {method}: {answer['error']}")
                return answer["result"]

    def receive(self):
        while b"\0" not in self.rest:
            part = os.read(self.source, 1 << 20)
            if not part:
                sys.exit("browser.py: Chromium ended, or took too long")
            self.rest += part
        message, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(message)
        method, parameters = message.get("method"), message.get("params", {})
        if method == "Runtime.consoleAPICalled":
            self.said.append(" ".join(str(one.get("value")) for one in parameters["args"]))
        elif method == "Runtime.exceptionThrown":
            self.said.append(parameters["exceptionDetails"].get("exception", {}).get("description", "exception"))
        elif method == "Log.entryAdded":
            self.said.append(parameters["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            if not url.startswith(("data:", "file:", "about:")):
                self.said.append(f"loads {url}")
        return message

    def run(self, script):
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            sys.exit(f"browser.py: {script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def open(self, path, width, height, scheme):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.call("Page.navigate", url=path.resolve().as_uri())
        self.run("new Promise((done) => document.readyState === 'complete' ? done() : addEventListener('load', done))")

    def screenshot(self, path):
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], 12000), "scale": 1}
        picture = self.call("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)
        path.write_bytes(base64.b64decode(picture["data"]))

    def close(self):
        self.alarm.cancel()
        self.browser.kill()
        self.browser.wait()


WIDE = """[...document.querySelectorAll('body *')].filter((one) => !one.closest('.wide') &&
    one.getBoundingClientRect().right > innerWidth + 1).map((one) => one.tagName + '.' + one.className)"""
BROKEN = """Promise.all([...document.images].map((one) => one.decode().then(() => one.naturalWidth > 0, () => false)
    .then((good) => good ? null : one.alt))).then((all) => all.filter((one) => one !== null))"""
# Of a colour of the page and what it stands on, by WCAG's formula.
CONTRAST = """(() => {
  const style = getComputedStyle(document.documentElement);
  const light = (name) => {
    const hex = style.getPropertyValue(name).trim();
    const part = (at) => { const c = parseInt(hex.slice(at, at + 2), 16) / 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
    return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
  };
  const ratio = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  const inks = ['--ink', '--faint', '--accent', '--good', '--bad'];
  return Math.min(...inks.flatMap((ink) => ['--paper', '--shade'].map((paper) => ratio(light(ink), light(paper)))));
})()"""
SHOWN = "[...document.querySelectorAll('#codecs tbody tr')].filter((row) => !row.hidden).map((row) => row.cells[0].textContent)"
FILTER = """(() => { const fields = document.getElementById('demand').elements; fields.%s.value = '%s';
    fields.%s.dispatchEvent(new Event('input', {bubbles: true})); })()"""
HEMISPHERE = """(() => { const box = document.getElementById('demand').elements.hemisphere; box.checked = %s;
    box.dispatchEvent(new Event('input', {bubbles: true})); })()"""
MEANS = "[...document.querySelectorAll('#codecs tbody tr')].filter((row) => !row.hidden).map((row) => Number(row.cells[3].textContent))"
UNLABELLED = """[...document.querySelectorAll('input, select')].filter((one) => one.labels.length === 0).length +
    [...document.images].filter((one) => !one.alt).length"""


def check(page, choose, hemisphere):
    """Complaints about an open page."""
    found = []
    if page.run("document.documentElement.scrollWidth > innerWidth"):
        found.append(f"the page is wider than its window: {page.run(WIDE)[:5]}")
    broken = page.run(BROKEN)
    if broken or page.run("document.images.length") == 0:
        found.append(f"pictures are not there: {broken}")
    contrast = page.run(CONTRAST)
    if not contrast >= 4.5:
        found.append(f"the contrast is {contrast}")
    if page.run(UNLABELLED):
        found.append("a field or a picture has no label")
    everything = page.run(SHOWN)
    page.run(FILTER % ("bits", "24", "bits"))
    bits = page.run("[...document.querySelectorAll('#codecs tbody tr')].filter((row) => !row.hidden).map((row) => Number(row.cells[1].textContent))")
    if not 0 < len(bits) < len(everything) or max(bits) > 24:
        found.append("the filter by bits does not work")
    page.run(FILTER % ("bits", "64", "bits"))
    page.run(FILTER % ("max", MAX_ERROR, "max"))
    for candidates, above in [(choose, "false"), (hemisphere, "true"), (choose, "false")]:
        page.run(HEMISPHERE % above)
        found += check_choice(page, candidates)
    page.run(FILTER % ("max", "", "max"))
    found += check_viewer(page)
    return found


def check_choice(page, candidates):
    if candidates is None:
        return []
    ids, shown = [codec["id"] for codec in candidates], page.run(SHOWN)
    if shown != ids:
        return [f"the page chooses {shown[:3]}, the program {ids[:3]}"]
    means = zip(page.run(MEANS), (codec["mean_deg"] for codec in candidates), ids)
    # The page has three digits.
    return [f"the page's mean of {id} is {mean}, the program's {exact}" for mean, exact, id in means if abs(mean - exact) > 0.006 * exact]


def check_viewer(page):
    if page.run("document.querySelectorAll('.viewer').length") != 1:
        return ["there is no slider between floats and codecs"]
    script = """(() => { const viewer = document.querySelector('.viewer'), slider = viewer.querySelector('.slider');
        slider.value = 20; slider.dispatchEvent(new Event('input'));
        const before = viewer.querySelector('.coded').src, codec = viewer.querySelector('.codec');
        codec.selectedIndex = codec.length - 1; codec.dispatchEvent(new Event('change'));
        const result = [viewer.querySelector('.float').style.clipPath, before !== viewer.querySelector('.coded').src];
        slider.value = 50; slider.dispatchEvent(new Event('input'));
        codec.selectedIndex = 0; codec.dispatchEvent(new Event('change'));
        return result; })()"""
    clip, changed = page.run(script)
    return [] if "80%" in clip and changed else ["the slider or the choice of a codec does not work"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("report", type=Path)
    parser.add_argument("--screenshots", type=Path)
    parser.add_argument("--choose", type=Path)
    parser.add_argument("--hemisphere", type=Path)
    parser.add_argument("chromium", nargs="?", default="chromium")
    parser.add_argument("libraries", nargs="*")
    arguments = parser.parse_args()
    choose, hemisphere = (
        json.loads(path.read_text())["candidates"] if path else None for path in [arguments.choose, arguments.hemisphere]
    )
    complaints = []
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        page = Page(arguments.chromium, arguments.libraries, profile)
        for width, height in WIDTHS.items():
            for scheme in ["light", "dark"]:
                page.open(arguments.report, width, height, scheme)
                complaints += [f"{width} pixels, {scheme}: {one}" for one in check(page, choose, hemisphere)]
                if arguments.screenshots:
                    arguments.screenshots.mkdir(exist_ok=True)
                    page.screenshot(arguments.screenshots / f"{width}_{scheme}.png")
        complaints += [f"the page says: {text}" for text in page.said]
        page.close()
    for complaint in complaints:
        print(complaint)
    if complaints:
        sys.exit("browser.py: the report should be silent, fit, show its pictures, filter and slide")
    print(f"browser.py: {arguments.report.name}: silent and whole at {' and '.join(map(str, WIDTHS))} pixels")


main()
