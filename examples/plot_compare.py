"""
All methods side by side
========================

What each method sees of one scene, how long it takes, how much memory, and what it counts. All must agree
wherever rounding cannot matter; brute force is the judge.
"""

import eyeline as el

SIZE = (640, 360)

found = el.compare(el.samples.piercing_faces(), size=SIZE)
for row in found.data()["methods"]:
    print(row["method"], row.get("wrong_pixels", row.get("refusal")))
found.save("compare.png")
