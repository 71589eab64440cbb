/// Setters of options, each for the field of its name in the C struct; the C headers tell units, ranges and defaults.
macro_rules! setters {
    ($($(#[$doc:meta])* $field:ident: $kind:ty $(=> $convert:expr)?;)*) => {$(
        $(#[$doc])*
        #[must_use]
        pub fn $field(mut self, $field: $kind) -> Self {
            self.plain.$field = setters!(@ $field $($convert)?);
            self
        }
    )*};
    (@ $field:ident) => { $field };
    (@ $field:ident $convert:expr) => { ($convert)($field) };
}

/// An enumeration of constants of the C interface.
macro_rules! constants {
    ($($(#[$doc:meta])* $name:ident { $($(#[$member_doc:meta])* $member:ident = $value:ident,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u32)]
        pub enum $name { $($(#[$member_doc])* $member = crate::sys::$value,)* }
        impl From<$name> for u32 {
            fn from(value: $name) -> u32 {
                value as u32
            }
        }
    )*};
}

/// Options of the C interface with their defaults.
macro_rules! defaults {
    ($kind:ident, $init:ident) => {{
        let mut plain = crate::sys::$kind::default();
        // SAFETY: the struct is as large as said.
        let status = unsafe { crate::sys::$init(&mut plain, std::mem::size_of::<crate::sys::$kind>()) };
        assert_eq!(status, crate::sys::LOCUS_OK, "the loaded liblocus is older than these bindings");
        plain
    }};
}

/// A struct for the library to fill.
macro_rules! sized {
    ($kind:ident) => {
        crate::sys::$kind { struct_size: std::mem::size_of::<crate::sys::$kind>() as u64, ..Default::default() }
    };
}
