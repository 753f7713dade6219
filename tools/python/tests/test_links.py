"""The relative links of the documentation lead to files, and to headings, that there are."""

import pathlib
import re
import tempfile
import unittest

from tamp import program

BLOCK = re.compile(r"^ *```.*?^ *```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`]*`")
LINK = re.compile(r"\[[^\]]*\]\(([^()\s]+)\)")
ELSEWHERE = re.compile(r"[a-z]+:")


def pages(root):
    return [root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md", root / "tests/recipes/README.md",
            *sorted(root.glob("docs/**/*.md"))]


def anchors(page):
    """The headings of a page as links name them."""
    made = []
    for line in BLOCK.sub("", page.read_text(encoding="utf-8")).splitlines():
        heading = re.match(r"#+ +(.*)", line)
        if heading:
            words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).strip().lower()
            anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
            n_before = sum(re.fullmatch(re.escape(anchor) + r"(-\d+)?", other) is not None for other in made)
            made.append(f"{anchor}-{n_before}" if n_before else anchor)
    return made


def broken_links(page):
    text = CODE.sub("", BLOCK.sub("", page.read_text(encoding="utf-8")))
    broken = []
    for link in LINK.findall(text):
        if ELSEWHERE.match(link):
            continue
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        if not target.exists() or anchor and (target.suffix != ".md" or anchor not in anchors(target)):
            broken.append(link)
    return broken


class Links(unittest.TestCase):
    def test_each_leads_somewhere(self):
        broken = [(page.relative_to(program.ROOT).as_posix(), link) for page in pages(program.ROOT)
                  for link in broken_links(page)]

        self.assertEqual(broken, [])

    def test_the_map_has_every_page(self):
        map_of_pages = program.ROOT / "docs/README.md"
        text = map_of_pages.read_text(encoding="utf-8")
        linked = {(map_of_pages.parent / link.partition("#")[0]).resolve() for link in LINK.findall(text)}

        missing = [page.name for page in program.ROOT.glob("docs/*/*.md") if page.resolve() not in linked]

        self.assertEqual(missing, [])

    def test_one_that_leads_nowhere_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, "page.md")
            page.write_text("# A `bar`, and [more](page.md)\n[a](page.md#a-bar-and-more) `[x](no.md)` [b\nc](no.md)\n"
                            "[d](#bars) [e](https://example.org/no.md)\n```\n# no heading\n```\n[f](#no-heading)\n")

            self.assertEqual(broken_links(page), ["no.md", "#bars", "#no-heading"])


if __name__ == "__main__":
    unittest.main()
