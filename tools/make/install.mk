# Rules of the install targets.
