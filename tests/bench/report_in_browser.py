#!/usr/bin/env python3
"""Opens the report of `phlux bench` in headless Chromium, wide and narrow, in light and dark.

    report_in_browser.py PHLUX SCENES [FOLDER]

Measures two of the scenes in SCENES for a second each. Output and screenshots go to FOLDER, by default a temporary folder.
The exit code is 77 (skipped) without Chromium or matplotlib.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SIZES = {"desktop": (1200, 2400), "narrow": (390, 2400)}
SCHEMES = {"dark": 0, "light": 1}  # Chromium's preferredColorScheme
PAPER = {"light": (255, 255, 255), "dark": (20, 24, 29)}
SERIES = {"light": (31, 102, 168), "dark": (98, 170, 240)}  # chart_style.py's first
LEAST_OF_SERIES = 150  # pixels


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIPPED)


def measure(program, scenes, folder):
    command = [program, "bench", "scenes", "--side", "16", "--seconds", "1", "--out", folder]
    for name in ("furnace-sphere", "cornell-box"):
        command += ["--scene", os.path.join(scenes, name + ".xml")]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def open_page(browser, folder, name, size, scheme):
    """A screenshot; fails on messages of the page, and on requests for any other address than the page."""
    screenshot, log = os.path.join(folder, name + ".png"), os.path.join(folder, name + ".netlog.json")
    command = [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--disable-extensions",
               "--disable-background-networking", "--disable-component-update", "--no-first-run", "--disable-sync",
               f"--user-data-dir={os.path.join(folder, 'profile')}", f"--window-size={size[0]},{size[1]}",
               f"--blink-settings=preferredColorScheme={SCHEMES[scheme]}", "--enable-logging=stderr",
               "--host-resolver-rules=MAP * ~NOTFOUND", f"--log-net-log={log}",
               f"--screenshot={screenshot}",
               "file://" + os.path.join(os.path.abspath(folder), "index.html")]
    outcome = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert outcome.returncode == 0 and os.path.exists(screenshot), outcome.stderr
    complaints = [line for line in outcome.stderr.splitlines() if "CONSOLE" in line]
    assert not complaints, complaints
    for url in requests_of(log):
        assert url.startswith(("file:", "data:", "chrome:", "devtools:")), f"the page asks for {url}"
    return screenshot


def requests_of(log):
    """The addresses that the page requested; Chromium's own requests, to Google, belong to no site."""
    with open(log, encoding="utf-8") as file:
        events = json.load(file)["events"]
    return {event["params"]["url"] for event in events
            if "site=file" in event.get("params", {}).get("site_for_cookies", "")}


def share_of(image, color):
    import numpy as np
    return int((np.abs(image[:, :, :3] * 255.0 - np.array(color)).max(axis=2) < 6).sum())


def look(screenshot, scheme):
    from matplotlib import image
    pixels = image.imread(screenshot)
    assert share_of(pixels, PAPER[scheme]) > 0.4 * pixels.shape[0] * pixels.shape[1], f"{screenshot}: not on {scheme} paper"
    assert share_of(pixels, SERIES[scheme]) > LEAST_OF_SERIES, f"{screenshot}: no chart in sight"


def main():
    program, scenes = sys.argv[1:3]
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        skip("no Chromium: install chromium to have the report opened")
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        skip("no matplotlib: install python3-matplotlib to have charts in the report")
    temporary = None
    if len(sys.argv) > 3:
        folder = sys.argv[3]
    else:
        temporary = tempfile.TemporaryDirectory()
        folder = temporary.name
    measure(program, scenes, folder)
    for width, size in SIZES.items():
        for scheme in SCHEMES:
            look(open_page(browser, folder, f"screen-{width}-{scheme}", size, scheme), scheme)
    print("opened in light and dark, wide and narrow: charts are there, nothing else was asked for")


if __name__ == "__main__":
    main()
