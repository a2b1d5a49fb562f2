"""Shapes between shapes: of meshes with the same faces, of any closed bodies, of drawn outlines."""

from eyeline.shapes.inbetween import WAYS as WAYS
from eyeline.shapes.inbetween import Inbetween as Inbetween
from eyeline.shapes.inbetween import inbetween as inbetween
