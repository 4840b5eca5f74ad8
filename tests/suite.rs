//! Every codec of the list, put to every test of [`unitvec_tests::suite`]: `suite::oct16p::symmetric`.

use unitvec::for_each_codec;

/// A module of tests for each codec.
macro_rules! codecs {
    ($([$id:ident $($rest:tt)*])*) => {
        $(mod $id {
            unitvec_tests::for_each_property!(tests! { $id: });
        })*
    };
}

/// A test for each property.
macro_rules! tests {
    ($id:ident: $($property:ident),*) => {$(
        #[test]
        fn $property() {
            unitvec_tests::suite::$property(&unitvec_tests::tested::Tested::find(stringify!($id)));
        }
    )*};
}

for_each_codec!(codecs);
