"""Rules that place nodes after the tracks have, one file each."""

from eyeline.motion.constraints.chain import Chain
from eyeline.motion.constraints.drive import Drive
from eyeline.motion.constraints.face import Face
from eyeline.motion.constraints.follow import Follow
from eyeline.motion.constraints.follow_path import FollowPath
from eyeline.motion.constraints.look_at import LookAt
from eyeline.motion.constraints.shake import Shake
from eyeline.motion.constraints.two_bone import TwoBone

CONSTRAINTS = {one.__name__: one for one in (Chain, Drive, Face, Follow, FollowPath, LookAt, Shake, TwoBone)}

__all__ = ["CONSTRAINTS", "Chain", "Drive", "Face", "Follow", "FollowPath", "LookAt", "Shake", "TwoBone"]
