#!/usr/bin/perl
# Mark a header's comments for doxygen.
undef $/;
my $text = <>;
$text =~ s{\A/\* (locus/\S+) - }{/** \@file\n * }; # the page of the header
$text =~ s{^(\s*)/\* (?=\S)}{$1/** }mg;            # before a declaration
$text =~ s{^(.*\S[ \t]*)/\* (?=\S)}{$1/**< }mg;    # behind a field or a constant
$text =~ s{\\(?=\d)}{}g;
print $text;
