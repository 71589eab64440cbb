#!/usr/bin/perl
# Mark a header's comments for doxygen.
undef $/;
my $text = <>;
$text =~ s{\A/\* (locus/\S+) - }{/** \@file\n * }; # the page of the header
$text =~ s{^(\s*)/\* (?=\S)}{$1/** }mg;            # before a declaration
$text =~ s{^(.*\S[ \t]*)/\* (?=\S)}{$1/**< }mg;    # behind a field or a constant
$text =~ s{\\(?=\d)}{}g;
# A block above several declarations in a row is that of each.
$text =~ s{(/\*\*(?:(?!\*/).)*\*/\n)((?:LOCUS_API [^;]*;\n){2,})}{my ($block, $all) = ($1, $2); $all =~ s/^(?=LOCUS_API)/$block/mg; $all}gse;
print $text;
