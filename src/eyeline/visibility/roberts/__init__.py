"""Roberts' hidden lines: the visible parts of the edges of every scene, in object space."""

from eyeline.visibility.roberts.roberts import Roberts as Roberts
