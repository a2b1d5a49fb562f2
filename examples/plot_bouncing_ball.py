"""
A bouncing ball
===============

The first exercise of every animator, as a film. The clip comes with the scene; a film without `start` and
`end` is all of it.
"""

import eyeline as el

SIZE = (480, 270)
FPS = 24

el.film(el.samples.bouncing_ball(), fps=FPS, size=SIZE).save("bouncing_ball.webp")
