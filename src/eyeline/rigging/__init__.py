"""Bodies that joints move: skeletons, and meshes bound to them by weights that are found, not painted."""

from eyeline.rigging.binding import bind as bind
from eyeline.rigging.skeleton import skeleton as skeleton
