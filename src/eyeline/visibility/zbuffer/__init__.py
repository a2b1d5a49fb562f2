"""Depth buffer: answers every scene, in time that grows with faces and covered pixels, in any order."""

from eyeline.visibility.zbuffer.zbuffer import ZBuffer as ZBuffer
