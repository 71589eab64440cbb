# Rules of the test targets.
