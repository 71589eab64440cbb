# Rules of the bench targets.
