# The quick tier of tests: everything `make test` runs. One GoogleTest program per folder of tests/unit.
UNIT_AREAS := $(sort $(notdir $(patsubst %/,%,$(dir $(wildcard tests/unit/*/*.cpp)))))
UNIT_PROGRAMS := $(UNIT_AREAS:%=$(OUT)/tests/unit_%)
$(UNIT_PROGRAMS): EXTRA_CPPFLAGS += -I.

define unit_program
$(OUT)/tests/unit_$(1): $(patsubst %,$(OUT)/%.o,$(wildcard tests/unit/$(1)/*.cpp)) $(LIB_STATIC)
	@echo "  LD  $$@"
	@$$(CXX) $$^ $$(UNIT_LIBS_$(1)) -lgtest_main -lgtest $$(LDFLAGS_ALL) -o $$@
.PHONY: unit-$(1)
unit-$(1): $(OUT)/tests/unit_$(1)
	$$< --gtest_brief=1
endef
$(foreach area,$(UNIT_AREAS),$(eval $(call unit_program,$(area))))

.PHONY: unit
unit: $(addprefix unit-,$(UNIT_AREAS)) ## run the unit tests only (unit-graph, unit-pmq, ... for one area)
