# The documentation: the guide, whose programs are tests, and the reference made from the headers.
.PHONY: guide docs
guide: $(SHARED_locus) $(SHARED_locus_cold) | $(call needs,test) ## compile and run the programs of docs/guide; each function has its documentation
	$(STAGE) $(FLAVOUR)$@ sh -c 'tests/docs/reference.py && tests/docs/guide.sh $(OUT)'
test: guide

# doxygen warns of nothing, or this fails.
docs: | $(call needs,docs) ## the reference of the C interface under build/docs/html
	@mkdir -p build/docs
	$(STAGE) $@ sh -c '(cat tools/docs/Doxyfile; echo OUTPUT_DIRECTORY = build/docs) | doxygen -'
check: docs
