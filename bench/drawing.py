# SPDX-License-Identifier: MIT
"""Figures as SVG: shapes, axes and legends in one style."""
import math
from xml.sax.saxutils import escape

# Okabe and Ito's colours, told apart by colour-blind readers too; each system has a marker besides.
STYLES = [("#000000", "circle"), ("#0072B2", "square"), ("#D55E00", "triangle"),
          ("#009E73", "diamond"), ("#CC79A7", "cross"), ("#E69F00", "ring"),
          ("#56B4E9", "plus"), ("#7F6A00", "box")]
INK, FAINT, GRID, PAPER = "#222222", "#5a5a5a", "#e4e4e4", "#ffffff"
# Pixels left of the first panel, for the numbers and the name of its axis.
LEFT = 66


class PlotError(Exception):
    """The figure cannot be drawn; the message says why."""


class Drawing:
    """A list of SVG elements; coordinates are pixels from the upper left."""

    def __init__(self):
        self.elements = []

    def line(self, x1, y1, x2, y2, colour, width=1.0, dash=""):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.elements.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
                             f'stroke="{colour}" stroke-width="{width}"{extra}/>')

    def curve(self, points, colour, width=1.8, dash=""):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.elements.append(f'<polyline points="{text}" fill="none" stroke="{colour}" '
                             f'stroke-width="{width}" stroke-linejoin="round"{extra}/>')

    def bar(self, x, y, width, height, colour):
        height = max(height, 1.5)  # None solved is still seen to have been run.
        self.elements.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{max(width - 0.8, 0.5):.1f}" '
                             f'height="{height:.1f}" fill="{colour}"/>')

    def text(self, x, y, text, size=12, anchor="middle", colour=INK, turn=False, bold=False):
        extra = f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turn else ""
        extra += ' font-weight="bold"' if bold else ""
        self.elements.append(f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" '
                             f'text-anchor="{anchor}" fill="{colour}"{extra}>{escape(text)}</text>')

    def marker(self, x, y, style, hollow=False):
        colour, shape = style
        fill = PAPER if hollow or shape in ("ring", "box") else colour
        paint = f'fill="{fill}" stroke="{colour}" stroke-width="1.5"'
        shapes = {
            "square": f'<rect x="{x - 3.6:.1f}" y="{y - 3.6:.1f}" width="7.2" height="7.2" {paint}/>',
            "box": f'<rect x="{x - 4:.1f}" y="{y - 4:.1f}" width="8" height="8" {paint}/>',
            "triangle": f'<path d="M{x:.1f} {y - 5:.1f}l4.8 8.4h-9.6z" {paint}/>',
            "diamond": f'<path d="M{x:.1f} {y - 5.4:.1f}l5.4 5.4l-5.4 5.4l-5.4 -5.4z" {paint}/>',
            "cross": f'<path d="M{x - 4:.1f} {y - 4:.1f}l8 8m0 -8l-8 8" stroke="{colour}" '
                     'stroke-width="2.4" fill="none"/>',
            "plus": f'<path d="M{x:.1f} {y - 5:.1f}v10m-5 -5h10" stroke="{colour}" '
                    'stroke-width="2.4" fill="none"/>',
        }
        self.elements.append(shapes.get(
            shape, f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" {paint}/>'))

    def write(self, path, width, height, title):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
                f'viewBox="0 0 {width} {height}" font-family="DejaVu Sans, Arial, sans-serif" '
                'role="img">\n<!-- SPDX-License-Identifier: MIT -->\n'
                f'<title>{escape(title)}</title>\n'
                f'<rect width="{width}" height="{height}" fill="{PAPER}"/>\n')
        with open(path, "w", encoding="utf-8") as file:
            file.write(head + "\n".join(self.elements) + "\n</svg>\n")


class Panel:
    """A framed area with axes that are linear or logarithmic."""

    def __init__(self, drawing, box, x_range, y_range, log, log_x=False):
        self.drawing, self.box, self.log, self.log_x = drawing, box, log, log_x
        self.x_range, self.y_range = x_range, y_range
        left, top, width, height = box
        drawing.elements.append(f'<rect x="{left}" y="{top}" width="{width}" height="{height}" '
                                f'fill="none" stroke="{FAINT}"/>')

    def x(self, value):
        scale = math.log10 if self.log_x else float
        low, high = map(scale, self.x_range)
        return self.box[0] + self.box[2] * (scale(value) - low) / (high - low)

    def y(self, value):
        scale = math.log10 if self.log else float
        low, high = map(scale, self.y_range)
        share = (scale(max(value, self.y_range[0]) if self.log else value) - low) / (high - low)
        return self.box[1] + self.box[3] * (1 - share)

    def x_ticks(self, values, numbers=True):
        bottom = self.box[1] + self.box[3]
        for value in values:
            self.drawing.line(self.x(value), self.box[1], self.x(value), bottom, GRID)
            if numbers:
                self.drawing.text(self.x(value), bottom + 16, f"{value:g}", 11)

    def y_ticks(self, values, unit=""):
        for value in values:
            at = self.y(value)
            self.drawing.line(self.box[0], at, self.box[0] + self.box[2], at, GRID)
            self.drawing.text(self.box[0] - 7, at + 4, f"{value:g}{unit}", 11, "end")


def ticks(low, high, most=9):
    """Round numbers in low..high, at most `most` steps."""
    size = 10.0 ** math.floor(math.log10(max(high - low, 1e-9) / most))
    step = next(size * f for f in (1, 2, 2.5, 5, 10, 20) if (high - low) / (size * f) <= most)
    step = max(step, 1)
    first = math.ceil(low / step)
    return [step * n for n in range(first, math.floor(high / step) + 1)]


def decades(low, high):
    return [10.0**n for n in range(math.ceil(math.log10(low) - 1e-9),
                                   math.floor(math.log10(high) + 1e-9) + 1)]


def half_decades(low, high):
    """1, 2 and 5 times the powers of ten in low..high."""
    return [f * ten for ten in decades(low / 10, high) for f in (1, 2, 5) if low <= f * ten <= high]


def legend(drawing, systems, styles, width, top, dashes=None, step=190):
    """A table of the markers below the panels; returns its height."""
    columns = max(1, min(len(systems), width // step))
    for index, system in enumerate(systems):
        x = LEFT + (index % columns) * step
        y = top + (index // columns) * 22
        drawing.line(x, y, x + 30, y, styles[system][0], 1.8, (dashes or {}).get(system, ""))
        drawing.marker(x + 15, y, styles[system])
        drawing.text(x + 38, y + 4, system, 12, "start")
    return 22 * -(-len(systems) // columns)
