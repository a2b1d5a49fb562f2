"""
A turntable
===========

A camera that goes once around a model. The suffix decides the format: `.mp4`, `.webm`, `.gif`, `.webp`, or a
folder of PNG frames where there is none.
"""

import eyeline as el

SIZE = (480, 270)
FPS = 15

film = el.film(el.samples.torus(), fps=FPS, turntable=3, size=SIZE)
film.save("turntable.webp")
