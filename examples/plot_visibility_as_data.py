"""
What is seen, as data
=====================

The same answer that makes the picture tells how much of each thing the viewer sees, and what hides the rest.
"""

import math

import eyeline as el

SIZE = (960, 540)


def standing(name, mesh, x, z, color):
    material = el.Material(name, base_color=(*color, 1.0), roughness=0.4)
    return el.Node(name, translation=(x, 0.0, z), mesh=mesh.with_material(material))


ball = el.samples.sphere().surfaces[0].mesh
scene = el.Scene.of(
    standing("red", ball, -0.35, 0.9, (0.8, 0.12, 0.08)),
    standing("yellow", ball, 0.4, 0.1, (0.9, 0.6, 0.1)),
    standing("blue", ball, -0.1, -0.9, (0.1, 0.25, 0.7)),
)
camera = el.Camera.look_at(eye=(0, 1.2, 6), target=(0, 0, 0), fov=math.radians(24))

seen = el.visible(scene, camera, size=SIZE)
for name in scene.paths:
    area = seen.area(name)
    hidden_by = (
        ", ".join(f"{other} ({pixels} pixels)" for other, pixels in area.occluders.items()) or "nothing"
    )
    print(f"{name:7}{area.fraction:6.1%} of {area.unoccluded_pixels} pixels seen; hidden by {hidden_by}")

el.render(scene, camera, size=SIZE).save("visibility_as_data.png")
