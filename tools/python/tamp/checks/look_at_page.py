"""Opens a page in Chromium without a window, wide, dark and as narrow as a phone, and says what its console says.

Written are OUT_FOLDER/wide.png, dark.png and phone.png. On each page it chooses points by script, as a person would,
and measures whether the page is wider than the window, and a table than its box. The exit code is 1 where the console
complains, the page scrolls sideways, on a phone a table does, or a point that is chosen shows nothing. Debian's
chromium is used; of the tests only those of the label `browser` want it.
"""

import html
import pathlib
import re
import subprocess
import tempfile

from tamp import files
from tamp.options import count

# A window of Chromium is 500 pixels wide at least; a phone is a frame within it.
LOOKS = {"wide": (1280, []), "dark": (1280, ["--blink-settings=preferredColorScheme=0"]), "phone": (360, [])}
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--allow-file-access-from-files", "--enable-logging=stderr", "--v=0", "--hide-scrollbars",
         "--virtual-time-budget=4000"]

# Chooses every point, and leaves what it finds in the title of the outer page.
PROBE = """
const frame = document.querySelector("iframe");
frame.onload = () => {
  const page = frame.contentDocument;
  const visible = [...page.querySelectorAll(".point")].filter(point => point.offsetParent !== null);
  let n_empty = 0;
  for (const point of visible) {
    point.focus();
    const shown = page.querySelector("#chosen h2");
    if (!shown || !point.getAttribute("aria-label").startsWith(shown.textContent)) n_empty += 1;
  }
  page.dispatchEvent(new KeyboardEvent("keydown", {key: "Escape"}));
  const left = page.querySelector("#chosen.shown") ? 1 : 0;
  if (CHOSEN && visible.length) visible[Math.min(2, visible.length - 1)].click();
  frame.contentWindow.scrollTo(0, 0);
  const closed = [...page.querySelectorAll("details:not([open])")];
  closed.forEach(details => details.open = true);
  const is_cut = table => table.getBoundingClientRect().right > table.parentElement.getBoundingClientRect().right + 0.5;
  const n_cut = [...page.querySelectorAll(".wide > table")].filter(is_cut).length;
  closed.forEach(details => details.open = false);
  document.title = `${visible.length} points, ${n_empty} that show nothing, ${left} panels left open, ` +
    `${n_cut} tables cut off, ` +
    `${page.documentElement.scrollWidth - frame.clientWidth} pixels too wide`;
};
"""


def framed(page, width, height, chosen=False):
    return ('<!DOCTYPE html><html><head><title>not loaded</title><link rel="icon" href="data:,"></head>'
            f'<body style="margin:0"><iframe src="{html.escape(page.resolve().as_uri())}" '
            f'style="border:0;width:{width}px;height:{height}px"></iframe>'
            f"<script>{PROBE.replace('CHOSEN', str(chosen).lower())}</script></body></html>")


def chromium(program, folder, page, flags):
    """Opens a page, by its address."""
    command = [program, *FLAGS, f"--user-data-dir={folder}/profile", *flags, page]
    return subprocess.run(command, capture_output=True, text=True, timeout=180)


def complaints(*outcomes):
    """The lines of the console, each once."""
    said = [line for outcome in outcomes for line in outcome.stderr.splitlines() if "CONSOLE" in line]
    return list(dict.fromkeys(said))


def look(options, name, width, flags, folder):
    outer = folder / f"{name}.html"
    outer.write_text(framed(options.page, width, options.height, options.chosen))
    size = f"--window-size={max(width, 500)},{options.height}"
    found = chromium(options.chromium, folder / name, outer.as_uri(), [*flags, size, "--dump-dom"])
    shot = f"--screenshot={options.out.resolve()}/{name}.png"
    picture = chromium(options.chromium, folder / name, outer.as_uri(), [*flags, size, shot])
    said = re.search("<title>(.*?)</title>", found.stdout)
    wrong = complaints(found, picture)
    said = said[1] if said else "not loaded"
    print(f"{name}: {said}; {len(wrong)} complaints")
    print("".join(f"  {line}\n" for line in wrong), end="")
    too_wide = re.search(r"(-?\d+) pixels too wide", said)
    fits = too_wide is not None and int(too_wide[1]) <= 0
    is_whole = name != "phone" or ", 0 tables cut off, " in said
    return not wrong and ", 0 that show nothing, 0 panels" in said and is_whole and fits


def add_arguments(parser):
    parser.add_argument("page", type=pathlib.Path, metavar="PAGE.html")
    parser.add_argument("out", type=pathlib.Path, metavar="OUT_FOLDER")
    parser.add_argument("--chromium", default="chromium")
    parser.add_argument("--height", type=count, default=4000, help="of the window (%(default)s)")
    parser.add_argument("--chosen", action="store_true", help="leave a point chosen in the pictures")


def main(options):
    files.check_file(options.page)
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        sound = [look(options, name, width, flags, pathlib.Path(folder)) for name, (width, flags) in LOOKS.items()]
    return 0 if all(sound) else 1
