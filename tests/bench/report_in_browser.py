#!/usr/bin/env python3
"""Opens the report of `phlux bench` in headless Chromium, wide and narrow, in light and dark.

    report_in_browser.py PHLUX SCENES [FOLDER]

Measures two of the scenes in SCENES for a second each, and the sampling of one material. Output and screenshots go to FOLDER,
by default a temporary folder.
The exit code is 77 (skipped) without Chromium or matplotlib.
"""
import html
import json
import os
import re
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
WHOLE_TABLES = (1200, 800)  # widths in which no table needs scrolling


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIPPED)


def measure(program, scenes, folder):
    command = [program, "bench", "scenes", "--side", "16", "--seconds", "1", "--out", folder]
    for name in ("furnace-sphere", "cornell-box"):
        command += ["--scene", os.path.join(scenes, name + ".xml")]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    command = [program, "bench", "sampling", "--case", ".3,.6,200,70", "--samples", "10000", "--out", folder]
    for strategy in ("cosine", "lobe-estimate-printed", "exact"):
        command += ["--strategy", strategy]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def command_of(browser, folder, *options):
    return [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--disable-extensions",
            "--disable-background-networking", "--disable-component-update", "--no-first-run", "--disable-sync",
            f"--user-data-dir={os.path.join(folder, 'profile')}", *options]


def open_page(browser, folder, name, size, scheme):
    """A screenshot; fails on messages of the page, and on requests for any other address than the page."""
    screenshot, log = os.path.join(folder, name + ".png"), os.path.join(folder, name + ".netlog.json")
    command = command_of(browser, folder, f"--window-size={size[0]},{size[1]}",
                         f"--blink-settings=preferredColorScheme={SCHEMES[scheme]}", "--enable-logging=stderr",
                         "--host-resolver-rules=MAP * ~NOTFOUND", f"--log-net-log={log}", f"--screenshot={screenshot}",
                         "file://" + os.path.join(os.path.abspath(folder), "index.html"))
    outcome = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert outcome.returncode == 0 and os.path.exists(screenshot), outcome.stderr
    complaints = [line for line in outcome.stderr.splitlines() if "CONSOLE" in line]
    assert not complaints, complaints
    for url in requests_of(log):
        assert url.startswith(("file:", "data:", "chrome:", "devtools:")), f"the page asks for {url}"
    return screenshot


def check_tables(browser, folder):
    """Opens every table of the sampling sections in frames of these widths; fails on those that are cut."""
    with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
        page = re.sub(r"<meta http-equiv[^>]*>", "", file.read()).replace("<details>", "<details open>")
    frames = "".join(f'<iframe width="{width}" height="900" srcdoc="{html.escape(page)}"></iframe>' for width in WHOLE_TABLES)
    script = """<script>onload = () => {
      let cut = [];
      for (const frame of document.querySelectorAll("iframe"))
        for (const box of frame.contentDocument.querySelectorAll(".scroll"))
          if (box.scrollWidth > box.clientWidth && !box.closest("#scenes"))
            cut.push(frame.width + ": " + box.textContent.slice(0, 60));
      document.body.innerHTML = "<pre>cut: " + cut.length + " " + cut.join(" | ") + "</pre>";
    }</script>"""
    with open(os.path.join(folder, "tables.html"), "w", encoding="utf-8") as file:
        file.write(f"<!DOCTYPE html><body>{frames}{script}</body>")
    command = command_of(browser, folder, "--dump-dom", "file://" + os.path.join(os.path.abspath(folder), "tables.html"))
    text = subprocess.run(command, capture_output=True, text=True, timeout=120).stdout
    assert "cut: 0" in text, f"tables are cut: {text[-1000:]}"


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
    check_tables(browser, folder)
    print("opened in light and dark, wide and narrow: charts are there, nothing else was asked for")


if __name__ == "__main__":
    main()
