"""Area subdivision: cuts the picture into quarters until each is easy, and keeps the quarters."""

from eyeline.visibility.warnock.warnock import Warnock as Warnock
