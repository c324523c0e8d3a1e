//! Enums whose values have names.

/// Names the values of an enum, one row a value: its list, its names, and the ways between both.
#[macro_export]
macro_rules! named {
    ($type:ident: $($value:ident $name:literal),+ $(,)?) => {
        impl $type {
            /// All values, in the order of the enum.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$value),+];

            /// Their names, in the same order.
            pub const NAMES: [&str; Self::ALL.len()] = [$($name),+];

            /// Its name.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $name),+
                }
            }

            /// The value with this name, if any.
            #[must_use]
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|value| value.name() == name)
            }
        }
    };
}
