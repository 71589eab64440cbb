# Installation under $(DESTDIR)$(PREFIX), and the Debian package.
PREFIX ?= /usr/local
INCLUDEDIR ?= $(PREFIX)/include
LIBDIR ?= $(PREFIX)/lib
PKGCONFIGDIR := $(LIBDIR)/pkgconfig
CMAKEDIR := $(LIBDIR)/cmake/Locus
INSTALL_HEADERS := $(wildcard include/locus/*.h include/locus/*.hpp)

# What is installed, as paths below DESTDIR; uninstall removes these, and the two folders that are Locus' own.
INSTALLED := $(INSTALL_HEADERS:include/%=$(INCLUDEDIR)/%) \
    $(foreach name,$(LIBRARIES),$(LIBDIR)/lib$(name).so.$(VERSION) $(LIBDIR)/lib$(name).so.$(SOVERSION) $(LIBDIR)/lib$(name).so \
        $(LIBDIR)/lib$(name).a $(PKGCONFIGDIR)/$(name).pc) \
    $(CMAKEDIR)/LocusConfig.cmake $(CMAKEDIR)/LocusConfigVersion.cmake \
    $(LIBDIR)/liblocus_cuda.so.$(VERSION) $(LIBDIR)/liblocus_cuda.so.$(SOVERSION)
INSTALLED_CUDA := $(if $(NVCC),$(SHARED_CUDA))

# What a program needs beside the static library NAME: $(call static_needs,NAME).
static_needs = $(strip $(LIBS_$(1)) -lstdc++ -lm -pthread)
SPACE := $() $()
CMAKE_CALLS := $(subst $() _locus,_locus,$(foreach name,$(LIBRARIES),_locus_library($(name) "$(subst $(SPACE),;,$(call static_needs,$(name)))" "$(BASES_$(name))")\n))
# $(call fill,TEMPLATE,FILE,NAME): put the values into a file of tools/packaging.
fill = sed -e 's|@PREFIX@|$(PREFIX)|g' -e 's|@INCLUDEDIR@|$(INCLUDEDIR)|g' -e 's|@LIBDIR@|$(LIBDIR)|g' -e 's|@VERSION@|$(VERSION)|g' \
    -e 's|@SOVERSION@|$(SOVERSION)|g' -e 's|@NAME@|$(3)|g' -e 's|@LIBS@|$(call static_needs,$(3))|g' -e 's|@BASES@|$(BASES_$(3))|g' -e 's|@LIBRARIES@|$(strip $(LIBRARIES))|g' \
    -e 's|@INCLUDEDIR_FROM_CMAKEDIR@|$(shell realpath -m --relative-to='$(CMAKEDIR)' '$(INCLUDEDIR)')|g' \
    -e 's|@CALLS@|$(CMAKE_CALLS)|g' tools/packaging/$(1) >'$(DESTDIR)$(2)'

.PHONY: install uninstall deb
install: $(foreach name,$(LIBRARIES),$(SHARED_$(name)) $(STATIC_$(name))) $(INSTALLED_CUDA) ## install headers, libraries, pkg-config and CMake files
	@install -d '$(DESTDIR)$(INCLUDEDIR)/locus' '$(DESTDIR)$(LIBDIR)' '$(DESTDIR)$(PKGCONFIGDIR)' '$(DESTDIR)$(CMAKEDIR)'
	@install -m 644 $(INSTALL_HEADERS) '$(DESTDIR)$(INCLUDEDIR)/locus'
	@install -m 644 $(foreach name,$(LIBRARIES),$(SHARED_$(name)) $(STATIC_$(name))) $(INSTALLED_CUDA) '$(DESTDIR)$(LIBDIR)'
	@cd '$(DESTDIR)$(LIBDIR)' && for name in $(LIBRARIES); do \
	    ln -sfn lib$$name.so.$(VERSION) lib$$name.so.$(SOVERSION) && ln -sfn lib$$name.so.$(SOVERSION) lib$$name.so || exit 1; done
	@$(if $(INSTALLED_CUDA),ln -sfn liblocus_cuda.so.$(VERSION) '$(DESTDIR)$(LIBDIR)/liblocus_cuda.so.$(SOVERSION)',true)
	@$(foreach name,$(LIBRARIES),$(call fill,library.pc.in,$(PKGCONFIGDIR)/$(name).pc,$(name)) &&) true
	@$(call fill,LocusConfig.cmake.in,$(CMAKEDIR)/LocusConfig.cmake)
	@$(call fill,LocusConfigVersion.cmake.in,$(CMAKEDIR)/LocusConfigVersion.cmake)
	@echo "installed Locus $(VERSION) in $(DESTDIR)$(PREFIX)"

uninstall: ## remove what install put there
	@rm -f $(INSTALLED:%='$(DESTDIR)%')
	@for folder in '$(INCLUDEDIR)/locus' '$(CMAKEDIR)'; do \
	    if [ -d "$(DESTDIR)$$folder" ]; then rmdir --ignore-fail-on-non-empty "$(DESTDIR)$$folder"; fi; done
	@echo "removed Locus $(VERSION) from $(DESTDIR)$(PREFIX)"

# One package of run-time and development files: build/liblocus_<version>_<architecture>.deb.
DEB = build/liblocus_$(VERSION)_$(shell dpkg --print-architecture).deb
deb: $(foreach name,$(LIBRARIES),$(SHARED_$(name)) $(STATIC_$(name))) $(INSTALLED_CUDA) | $(call needs,check) ## build a Debian package under build/
	@rm -rf $(OUT)/deb
	@+$(MAKE) --no-print-directory install DESTDIR=$(OUT)/deb PREFIX=/usr LIBDIR=/usr/lib/$(shell $(CXX) -print-multiarch) >/dev/null
	@tools/packaging/deb.sh $(OUT)/deb $(DEB) $(VERSION)
	@echo "built $(DEB)"
