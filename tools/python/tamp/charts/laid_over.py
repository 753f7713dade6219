"""Pictures of squares laid over drawn axes, in as many squares as a page has room for."""

import base64

import numpy as np

from tamp.charts import picture, shades

LEAST_SQUARES = 60  # along the longer side
SAMPLE = 8  # of each list


def drawing(sheet, name, title, description, kind, source=""):
    """Axes of a kind of page, broad or narrow; without a source a script lays the picture over them."""
    made = picture.as_picture(sheet.figure, name, title, description)
    sheet.axis.apply_aspect()
    box = sheet.axis.get_position()
    place = f"left:{100 * box.x0:.3f}%;top:{100 * (1 - box.y1):.3f}%;width:{100 * box.width:.3f}%"
    address = f' src="data:image/png;base64,{source}"' if source else ""
    return (f'<div class="drawing {kind}">\n{picture.within_page(made)}<img alt=""{address} '
            f'style="{place};height:{100 * box.height:.3f}%">\n</div>\n')


def fitted(shown, scales, most_bytes, share=1.0):
    """Pictures, as texts, of lists of squares by names, in the colours of scales of these names, together at most as
    large as they may be, and the share of their squares along a side that is left."""
    some = {name: squares[:: -(-len(squares) // SAMPLE)] for name, squares in shown.items()}
    n, n_some = (sum(map(len, lists.values())) for lists in (shown, some))
    if n_some < n:  # found with a few, so that all are made once or twice
        share = fitted(some, scales, 0.97 * most_bytes * n_some / n, share)[1]
    longest = max(size for squares in shown.values() for size in squares[0].shape)
    while True:
        made = {name: [as_text(shades.png(thinned(one, share), scales[name])) for one in squares]
                for name, squares in shown.items()}
        n_bytes = sum(len(text) for texts in made.values() for text in texts)
        if n_bytes <= most_bytes or share * longest <= LEAST_SQUARES:
            return made, share
        share *= max(min(0.98 * (most_bytes / n_bytes) ** 0.5, 0.98), 0.3)


def thinned(shown, share):
    """Every so manieth square."""
    wanted = [max(round(n * share), 1) for n in shown.shape]
    rows, columns = (((np.arange(few) + 0.5) * n / few).astype(int) for few, n in zip(wanted, shown.shape))
    return shown[rows[:, None], columns]


def as_text(content):
    return base64.b64encode(content).decode()
