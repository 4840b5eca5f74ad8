//! The variants of the renderer's shaders, and their sources.

use super::projection::Projection;
use super::shaders;
use super::storage::Storage;
use crate::Result;
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::HashMap;
use unitvec_catalogue::{AnyCodec, Element};
use unitvec_run::backend::BackendKind;
use unitvec_run::glsl;
use unitvec_run::shader::Edition;

/// The normals that shaders are compiled for, and their storage.
#[derive(Clone, Copy)]
pub struct Variant {
    normals: Stored,
    pub(super) storage: Storage,
}

/// The stored form of normals.
#[derive(Clone, Copy)]
enum Stored {
    Float,
    Codec(&'static AnyCodec),
    Dithered(&'static AnyCodec),
    Projected(&'static Projection),
}

impl Variant {
    /// The normal itself.
    pub const FLOAT: Self = Self { normals: Stored::Float, storage: Storage::Float };

    /// A codec.
    pub const fn codec(format: &'static AnyCodec, storage: Storage) -> Self {
        Self { normals: Stored::Codec(format), storage }
    }

    /// A codec with an offset, its codes in integers; `None` for one that is not among [`shaders::dithered`].
    pub fn dithered(format: &'static AnyCodec) -> Option<Self> {
        let storage = Storage::integers(format);
        shaders::dithered()
            .any(|id| id == format.id)
            .then_some(Self { normals: Stored::Dithered(format), storage })
    }

    /// The numbers of a projection, in a format to choose.
    pub const fn projected(projection: &'static Projection) -> Self {
        Self { normals: Stored::Projected(projection), storage: projection.storage }
    }

    /// The module's name, with which the names of its entry points begin: `oct16_dithered`.
    pub fn name(&self) -> String {
        match self.normals {
            Stored::Float => "float".to_owned(),
            Stored::Codec(format) if self.storage == Storage::of(format) => format.id.to_owned(),
            // Codes in integers though the codec has a format.
            Stored::Codec(format) => format!("{}_uint", format.id),
            Stored::Dithered(format) => format!("{}_dithered", format.id),
            Stored::Projected(projection) => projection.name.to_owned(),
        }
    }

    /// The macros of its GLSL.
    pub(super) fn macros(&self) -> Vec<(String, String)> {
        // `STORAGE_SNORM8X2`.
        let mut macros = vec![(format!("STORAGE_{:?}", self.storage).to_uppercase(), "1".to_owned())];
        let mut define = |name: &str, value: String| macros.push((name.to_owned(), value));
        match self.normals {
            Stored::Float => {}
            Stored::Codec(format) => {
                define("ENCODE", format!("{}_encode", format.id));
                define("DECODE", format!("{}_decode", format.id));
                if format.element == Element::Frame {
                    define("FRAME", "1".to_owned());
                }
            }
            Stored::Dithered(format) => {
                define("ENCODE", format!("{}_encode_dithered", format.id));
                define("DECODE", format!("{}_decode_dithered", format.id));
                define("DITHERED", "1".to_owned());
            }
            Stored::Projected(projection) => {
                projection.macros().into_iter().for_each(|(name, value)| define(name, value));
            }
        }
        macros
    }
}

/// The shaders of the renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Stage {
    /// Vertices, whose normals are in a variant's storage.
    Vertex,
    /// Writes codes.
    Gbuffer,
    /// Decodes and lights them.
    Light,
    /// A triangle that covers the target, the same in all variants.
    Fullscreen,
}

pub(super) struct Compiled {
    pub(super) spirv: Cow<'static, [u8]>,
    pub(super) entry_point: String,
}

/// The source of the shaders.
pub(super) enum Shaders {
    /// The modules that rust-gpu made.
    Rust,
    /// GLSL, compiled when it is first asked for.
    Glsl { compiler: Box<glsl::Compiler>, compiled: RefCell<HashMap<(String, Stage), Vec<u8>>> },
}

impl Shaders {
    pub(super) fn of(source: BackendKind) -> Result<Self> {
        match source {
            BackendKind::Rust => Ok(Self::Rust),
            BackendKind::Glsl => {
                // As the modules from Rust: the CPU's bits on devices that divide loosely.
                let compiler = Box::new(glsl::Compiler::of(Edition::Exact)?);
                Ok(Self::Glsl { compiler, compiled: RefCell::default() })
            }
            BackendKind::Cpu | BackendKind::Hlsl | BackendKind::Wgsl => {
                Err(super::Error::NoSuchShaders(source))
            }
        }
    }

    /// True where there are modules of this variant.
    pub(super) fn has(&self, variant: &Variant) -> bool {
        matches!(self, Self::Glsl { .. }) || shaders::module(&format!("{}.spv", variant.name())).is_some()
    }

    pub(super) fn compile(&self, variant: &Variant, stage: Stage) -> Result<Compiled> {
        let (name, suffix, file) = match stage {
            Stage::Vertex => (variant.name(), "vertex", "vertex.vert"),
            Stage::Gbuffer => (variant.name(), "gbuffer", "gbuffer.frag"),
            Stage::Light => (variant.name(), "light", "light.frag"),
            Stage::Fullscreen => ("fullscreen".to_owned(), "vertex", "fullscreen.vert"),
        };
        match self {
            Self::Rust => {
                let module = format!("{name}.spv");
                let spirv = shaders::module(&module).ok_or(super::Error::NoModule(module))?;
                Ok(Compiled { spirv: Cow::Borrowed(spirv), entry_point: format!("{name}_{suffix}") })
            }
            Self::Glsl { compiler, compiled } => {
                let key = (name, stage);
                let known = compiled.borrow().get(&key).cloned();
                let spirv = match known {
                    Some(spirv) => spirv,
                    None => shaders::compile_glsl(compiler, file, &key.0, &variant.macros())?,
                };
                compiled.borrow_mut().insert(key, spirv.clone());
                Ok(Compiled { spirv: Cow::Owned(spirv), entry_point: glsl::ENTRY_POINT.to_owned() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_catalogue as catalogue;

    #[test]
    fn names_say_codec_and_kind() {
        let format = |id| catalogue::find(id).unwrap();
        let named = |id| Variant::codec(format(id), Storage::of(format(id))).name();
        assert_eq!((named("oct16"), named("frame32")), ("oct16".to_owned(), "frame32".to_owned()));
        assert_eq!(Variant::codec(format("snorm10x3"), Storage::Uint).name(), "snorm10x3_uint");
        assert_eq!(Variant::FLOAT.name(), "float");
        for id in shaders::dithered() {
            assert_eq!(Variant::dithered(format(id)).unwrap().name(), format!("{id}_dithered"));
        }
        let projection = Projection::find("oct16p_snorm").unwrap();
        assert_eq!(Variant::projected(projection).name(), "oct16p_snorm");
        assert!(Variant::dithered(format("fib16")).is_none());
    }

    /// Every codec whose format need not be an attachment has shaders for integers, and no other has.
    #[test]
    fn every_device_can_draw_every_codec() {
        for format in catalogue::directions() {
            let name = format!("{}_uint.spv", format.id);
            assert_eq!(shaders::module(&name).is_none(), Storage::of(format).is_drawn_everywhere(), "{name}");
        }
    }
}
