"""Ray casting over a tree of boxes: answers every scene; time grows with pixels, hardly with faces."""

from eyeline.visibility.raycast.raycast import RayCast as RayCast
