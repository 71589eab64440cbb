# Rules of the demo targets.
