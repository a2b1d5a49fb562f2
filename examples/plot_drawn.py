"""
Drawn over rendered
===================

A bird in nine key drawings flies over a rendered film. The exposure sheet says which drawing is shown when:
on twos, with three in-betweens from key to key, made from the outlines. Wings, body, beak and eye keep
their names from drawing to drawing, so each becomes itself.
"""

import math
import tempfile
from pathlib import Path

import eyeline as el

SIZE = (480, 320)
FPS = 24


def wing(tip, sweep, colour, name):
    """A wing from the back of a bird at the origin to a tip so high, swept back so far."""
    x, y = -sweep, -tip
    front = f"M14 -6 C10 {y * 0.5:g} {x * 0.4:g} {y:g} {x:g} {y:g}"
    back = f"C{x * 0.7:g} {y * 0.6:g} -22 {y * 0.2:g} -18 -2 Z"
    return f'<path id="{name}" d="{front} {back}" fill="{colour}" stroke="#27303f" stroke-width="2"/>'


def bird(x, y, flap, lean):
    """The bird at a place of a sheet of 480 by 320: wings up at flap 1, down at -1; lean in degrees."""
    body = "M36 -2 C28 -16 6 -14 -14 -6 L-50 -12 L-44 2 L-52 10 L-14 8 C8 16 30 12 36 -2 Z"
    return f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 480 320" width="480" height="320">
    <g transform="translate({x} {y}) rotate({lean})" stroke-linejoin="round">
    {wing(50 * flap, 26, "#5e7fae", "far wing")}
    <path id="body" d="{body}" fill="#7ea3d8" stroke="#27303f" stroke-width="2"/>
    <path id="beak" d="M35 -5 L52 0 L34 3 Z" fill="#f2a33c" stroke="#27303f" stroke-width="2"/>
    <circle id="eye" cx="25" cy="-5" r="2.6" fill="#27303f"/>
    {wing(62 * flap, 34, "#96b8ea", "near wing")}
    </g></svg>"""


stage = el.film(el.samples.bouncing_ball(), fps=FPS, end=66 / 24, size=SIZE)
keys = [f"key_{number}" for number in range(9)]
cells = [cell for key in keys for cell in (key, *["inbetween"] * 3)][:-3]

with tempfile.TemporaryDirectory() as folder:
    for number, key in enumerate(keys):
        along = number / (len(keys) - 1)
        place = (
            -60 + 600 * along,
            120 - 60 * math.sin(math.pi * along),
            (-1) ** number,
            14 * (2 * along - 1),
        )
        Path(folder, f"{key}.svg").write_text(bird(*place))
    sheet = Path(folder, "bird.csv")
    sheet.write_text("\n".join(["bird", *cells]) + "\n")
    film = el.exposure_sheet(sheet, on=2, size=SIZE, under=stage)
    print(f"{len(film)} frames, {len(keys)} of them drawn")
    film.save("drawn.webp")
