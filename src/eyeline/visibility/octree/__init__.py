"""Octree and depth pyramid: answers every scene, in time that grows with what is seen of it."""

from eyeline.visibility.octree.octree import Octree as Octree
