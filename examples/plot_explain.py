"""
A method at work
================

The depth buffer on three sheets that cut through each other, face by face: where each is the nearest so far,
and where not.
"""

import eyeline as el

SIZE = (96, 54)

steps = el.explain(el.samples.piercing_faces(), "zbuffer", size=SIZE)
for step in list(steps)[:5]:
    print(step.sentence)
steps.save("explain.webp")
