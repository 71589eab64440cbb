# Rules of the check targets.
