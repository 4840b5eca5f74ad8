//! Stub for builds without the feature `glsl`: `new` always fails.

use super::{Error, Optimisation, Shader, SourceLanguage};
use std::convert::Infallible;

pub struct Glslang(Infallible);

impl Glslang {
    pub fn new() -> Result<Self, Error> {
        Err(Error::NotBuiltIn)
    }

    pub fn compile(
        &self,
        _: SourceLanguage,
        _: &Shader<'_>,
        _: &[(String, String)],
        _: Optimisation,
    ) -> Result<Vec<u8>, String> {
        match self.0 {}
    }
}
