"""Rules that place nodes after the tracks have, one file each."""

from eyeline.motion.constraints.follow import Follow
from eyeline.motion.constraints.follow_path import FollowPath
from eyeline.motion.constraints.look_at import LookAt

__all__ = ["Follow", "FollowPath", "LookAt"]
