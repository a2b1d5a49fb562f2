"""Drawn animation: drawings exposed frame by frame, layer over layer, over rendered films."""

from eyeline.drawn.cels import cel as cel
from eyeline.drawn.cels import picture as picture
from eyeline.drawn.sheet import ExposureSheet as ExposureSheet
from eyeline.drawn.sheet import exposure_sheet as exposure_sheet
