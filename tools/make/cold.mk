# liblocus_cold, the SQLite tier of a PMQ: a library of its own, shared and static, over liblocus.
$(eval $(call library,locus_cold,$(wildcard src/cold/*.cpp),$(COLD_HEADERS),-lsqlite3,cold,locus))
MAY_NEED_locus_cold := liblocus\.so\.$(SOVERSION)|libsqlite3\.so\.0

.PHONY: cold
cold: $(SHARED_locus_cold) $(STATIC_locus_cold) ## build liblocus_cold.so and liblocus_cold.a, the SQLite tier
	@echo "built $(SHARED_locus_cold)"
