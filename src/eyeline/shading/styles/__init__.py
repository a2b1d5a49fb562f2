"""The ways to draw: STYLES, name -> Style. One file a style; a new one is one line here."""
