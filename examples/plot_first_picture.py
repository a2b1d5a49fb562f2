"""
A first picture
===============

A built-in model becomes a picture. Without a camera the view is three-quarter; without a light there is a
small studio: a key light, a floor that takes the shadow, a soft backdrop.
"""

import eyeline as el

SIZE = (960, 540)

scene = el.samples.teapot()
picture = el.render(scene, size=SIZE)
picture.save("first_picture.png")
