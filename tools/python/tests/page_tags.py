"""A page as its tags."""

import html.parser


class Tags(html.parser.HTMLParser):
    """All start tags of a page, and whether every element is closed in order."""

    EMPTY = {"meta", "link", "br", "img", "input"}

    def __init__(self, text):
        super().__init__()
        self.found, self.open, self.wrong = [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.found.append((tag, dict(attributes)))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.found.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)

    def of(self, name, **attributes):
        wanted = {key.rstrip("_"): value for key, value in attributes.items()}
        return [a for tag, a in self.found if tag == name and all(a.get(key) == value for key, value in wanted.items())]

    def sources(self):
        """Targets that the page would load or lead to."""
        return [value for _, a in self.found for key, value in a.items() if key in ("src", "href", "xlink:href")]
