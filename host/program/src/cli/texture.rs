use super::many::{check_beside, each, pairs};
use super::summary::{Options, Told, UPPER_ONLY};
use super::{counted, degrees};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec::angle_deg;
use unitvec_catalogue::{AnyCodec, Domain, find_vector};
use unitvec_files::{shown, write_file};
use unitvec_host::input::{Input, has_ending};
use unitvec_host::{Error, Result};
use unitvec_texture::block::Compression;
use unitvec_texture::mips::{Level, chain};
use unitvec_texture::{Coding, NormalMap, Source, Texture, dds, format, ktx2, picture, space};

#[derive(Args)]
pub struct Arguments {
    /// Codec of vectors of OUT, as `unitvec codecs` lists them: hemioct16 for tangent space, oct16p for object space. Not needed
    /// where IN has one. A png holds components: of the vectors that the codec leaves, where one is given.
    #[arg(long, value_name = "ID")]
    codec: Option<String>,
    /// Codec of IN, where that is a ktx2 or dds of codes that does not name it.
    #[arg(long, value_name = "ID")]
    from: Option<String>,
    /// Write codes of two SNORM channels, such as hemioct16's, to UNORM ones.
    #[arg(long)]
    unorm: bool,
    /// Compress the two channels of a codec of hemioct, xyonly or oct: to BC5, of SNORM without --unorm, or to BC7.
    #[arg(long, value_name = "bc5|bc7", value_parser = ["bc5", "bc7"])]
    compress: Option<String>,
    /// Direction of y, green, in IN: up the image as in OpenGL and glTF, or down as in Direct3D. Guessed if not given.
    #[arg(long, value_enum)]
    y: Option<Y>,
    /// Turn y round.
    #[arg(long)]
    flip_y: bool,
    /// Write all levels, averaged as vectors.
    #[arg(long)]
    mips: bool,
    /// Write the roughness that a mirror gets from the normals that each level averages: all levels to a ktx2 or dds, or side by
    /// side to a png. With `alpha`, to the codec's spare channel, which hemioct24 and unorm8x3 have, for example.
    #[arg(long, value_name = "FILE|alpha")]
    roughness: Option<PathBuf>,
    /// Write the error of each texel as a png, black to white; the summary says what white is.
    #[arg(long, value_name = "FILE")]
    heat: Option<PathBuf>,
    /// Bits of a channel of a png.
    #[arg(long, value_name = "8|16", default_value = "16", value_parser = PossibleValuesParser::new(["8", "16"]).try_map(|bits| bits.parse::<u32>()))]
    bits: u32,
    /// Ending of the files that a folder OUT gets.
    #[arg(long, value_name = "ktx2|dds|png", default_value = KINDS[0], value_parser = KINDS)]
    ending: String,
    #[command(flatten)]
    summary: Options,
    /// Normal map: png, jpeg, tga, exr, ktx2 or dds, the latter two without supercompression; or a folder, whose pictures and
    /// textures are taken, all as normal maps.
    #[arg(required = true, num_args = 1..)]
    r#in: Vec<PathBuf>,
    /// Output file: .ktx2, .dds or .png; or a folder that exists, which gets a file for each input.
    out: PathBuf,
}

/// The kinds of outputs, their endings.
const KINDS: [&str; 3] = ["ktx2", "dds", PNG];

const PNG: &str = "png";

/// A direction of y.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Y {
    Up,
    Down,
}

impl Y {
    fn name(self) -> &'static str {
        if self == Self::Up { "up" } else { "down" }
    }
}

/// The kind of an output, its ending.
fn kind_of(path: &Path) -> Result<&'static str> {
    let kind = KINDS.into_iter().find(|ending| has_ending(path, &[ending]));
    kind.ok_or_else(|| Error::Usage(format!("{} has to end in .ktx2, .dds or .png", path.display())))
}

fn write(kind: &str, texture: &Texture) -> Result<Vec<u8>> {
    Ok(if kind == "dds" { dds::write(texture)? } else { ktx2::write(texture) })
}

impl Arguments {
    /// The file of the roughness, where it gets one.
    fn roughness_file(&self) -> Option<&PathBuf> {
        self.roughness.as_ref().filter(|path| path.as_os_str() != "alpha")
    }
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let find = |id: &Option<String>| id.as_ref().map(|id| find_vector(id)).transpose();
    let codecs = (find(&arguments.codec)?, find(&arguments.from)?);
    let pairs = pairs(&arguments.r#in, &arguments.out, unitvec_texture::has_ending, Some(&arguments.ending))?;
    for beside in arguments.heat.iter().chain(arguments.roughness_file()) {
        check_beside(beside, &pairs, false)?;
    }
    each(&arguments.summary, &pairs, &arguments.out, |input, out| one(arguments, codecs, input, out))?;
    Ok(ExitCode::SUCCESS)
}

/// The codecs of the output and of the input, where they are given.
type Codecs = (Option<&'static AnyCodec>, Option<&'static AnyCodec>);

/// Converts an input. Returns what is told of it, and that it went to no standard output.
fn one(arguments: &Arguments, (codec, from): Codecs, input: &Path, out: &Path) -> Result<(Summary, bool)> {
    let kind = kind_of(out)?;
    let mut source = Input::open(input)?.texture(from)?;
    let coding = coding(arguments, kind, codec.or(source.codec.filter(|_| kind != PNG)))?;
    let is_object_space = space::is_object_space(&source.map);
    let below_equator = space::count_below(&source.map);
    let is_upper = |coding: &Coding| coding.codec.domain == Domain::Hemisphere;
    if let Some(coding) = coding.filter(|coding| is_object_space && is_upper(coding)) {
        return Err(Error::Usage(format!(
            "{} is of object space: z < 0 in {below_equator} of {} texels, and {} is for z >= 0 only; take oct16p, for \
             example",
            input.display(),
            source.map.vectors.len(),
            coding.codec.id
        )));
    }
    let (y, correlation) = direction(arguments, &source, is_object_space);
    if arguments.flip_y {
        source.map.flip_y();
    }
    let is_moved = below_equator > 0 && coding.as_ref().is_some_and(is_upper);
    let warnings = warnings(kind, coding, &source, is_moved);
    let levels = levels(arguments, coding, &source.map)?;
    let bytes = file(arguments, kind, coding, &source.map, &levels, y)?;
    let written = unitvec_texture::read(out, &bytes, coding.map(|it| it.codec).filter(|_| kind == "dds"))?;
    let pairs = source.map.vectors.par_iter().zip(&written.map.vectors);
    let errors: Vec<f64> = pairs.map(|(v, written)| angle_deg(*v, *written)).collect();
    let max_deg = errors.iter().copied().fold(0.0, f64::max);
    write_file(out, &bytes)?;
    if let Some(path) = arguments.roughness_file() {
        write_file(path, &roughness(path, &levels)?)?;
    }
    if let Some(path) = &arguments.heat {
        write_file(path, &picture::heat(source.map.width, source.map.height, &errors)?)?;
    }
    let summary = Summary {
        codec: coding.map(|coding| coding.codec.id),
        read: source.format,
        written: written.format,
        size: [source.map.width, source.map.height],
        levels: if arguments.mips { levels.len() } else { 1 },
        space: if is_object_space { "object" } else { "tangent" },
        y: y.map(Y::name),
        y_correlation: correlation,
        filled: source.filled,
        lengths: source.lengths,
        below_equator,
        mean_deg: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
        max_deg,
        heat: arguments.heat.clone(),
        warnings,
    };
    Ok((summary, false))
}

/// The coding of the output; none for the components of a png.
fn coding(arguments: &Arguments, kind: &str, codec: Option<&'static AnyCodec>) -> Result<Option<Coding>> {
    let usage = |words: &str| Err(Error::Usage(words.to_owned()));
    match codec {
        _ if kind == PNG && arguments.mips => {
            usage("a png has no levels; name an OUT that ends in .ktx2 or .dds, or leave --mips out")
        }
        Some(codec) => Ok(Some(match arguments.compress.as_deref() {
            None => Coding::of(codec, arguments.unorm)?,
            Some("bc7") => Coding::compressed(codec, Compression::Bc7)?,
            Some(_) if arguments.unorm => Coding::compressed(codec, Compression::Bc5Unorm)?,
            Some(_) => Coding::compressed(codec, Compression::Bc5Snorm)?,
        })),
        None if kind != PNG => usage(
            "--codec has to name the codec of OUT: hemioct16 for tangent space, oct16p for object space, unorm8x3 for \
             components",
        ),
        None if arguments.unorm || arguments.compress.is_some() => {
            usage("--unorm and --compress apply to codes; add --codec, such as hemioct16")
        }
        None => Ok(None),
    }
}

/// The direction of y in the output, and the correlation that tells it where nothing else does.
fn direction(arguments: &Arguments, source: &Source, is_object_space: bool) -> (Option<Y>, Option<f64>) {
    /// Less is noise, as at the borders of baked islands: of 49 maps of published glTF files, whose y points up, 4 have -0.28 to
    /// -0.12. Beyond it 19 are clear, and 3 at -0.9 or below, which are wrong themselves.
    const CLEAR: f64 = 0.3;
    let named = source.y.as_ref().and_then(|name| Y::from_str(name, false).ok());
    let (y, correlation) = match arguments.y.or(named) {
        None if !is_object_space => {
            let upward = space::upward(&source.map);
            let y = if upward > 0.0 { Y::Up } else { Y::Down };
            (Some(y).filter(|_| upward.abs() >= CLEAR), Some(upward))
        }
        y => (y, None),
    };
    let turned = |y: Y| if (y == Y::Up) == arguments.flip_y { Y::Down } else { Y::Up };
    (y.map(turned), correlation)
}

/// What the output loses, vectors below the equator among it, and a doubt of the input.
fn warnings(kind: &str, coding: Option<Coding>, source: &Source, is_moved: bool) -> Vec<String> {
    const ALPHA: &str = "alpha is dropped: take a codec with a channel to spare, such as hemioct24 or oct24p, or a texture of its own";
    const BIASED: &str = "no x or y is below 0: if its values are biased, 0 to 1, save them as a png";
    let has_alpha = kind == PNG || coding.is_none_or(|coding| coding.has_alpha());
    let is_positive = source.map.vectors.iter().all(|[x, y, _]| *x >= 0.0 && *y >= 0.0);
    let found = [
        (source.map.alpha.is_some() && !has_alpha, ALPHA),
        (is_moved, UPPER_ONLY),
        (is_positive && source.format.starts_with("exr") && source.lengths.is_some(), BIASED),
    ];
    found.into_iter().filter(|(is_found, _)| *is_found).map(|(_, words)| words.to_owned()).collect()
}

/// The levels, where they are written, or their roughness is.
fn levels(arguments: &Arguments, coding: Option<Coding>, map: &NormalMap) -> Result<Vec<Level>> {
    let mut levels = match arguments.mips || arguments.roughness.is_some() {
        true => chain(map),
        false => Vec::new(),
    };
    if arguments.roughness.as_ref().is_some_and(|path| path.as_os_str() == "alpha") {
        if map.alpha.is_some() || !arguments.mips || coding.is_none_or(|coding| !coding.has_alpha()) {
            let words = "--roughness alpha needs --mips, a map without alpha and a codec with a channel to spare, such as \
                hemioct24; or name a file";
            return Err(Error::Usage(words.to_owned()));
        }
        levels.iter_mut().for_each(|level| level.map.alpha = Some(level.roughness()));
    }
    Ok(levels)
}

/// The bytes of the output.
fn file(
    arguments: &Arguments,
    kind: &str,
    coding: Option<Coding>,
    map: &NormalMap,
    levels: &[Level],
    y: Option<Y>,
) -> Result<Vec<u8>> {
    let Some(coding) = coding else { return Ok(picture::write(map, arguments.bits)?) };
    if kind == PNG {
        let kept = coding.unpack(&coding.pack(map), map.width, map.height);
        return Ok(picture::write(&NormalMap { alpha: map.alpha.clone(), ..kept }, arguments.bits)?);
    }
    let levels = match arguments.mips {
        true => levels.iter().map(|level| coding.pack(&level.map)).collect(),
        false => vec![coding.pack(map)],
    };
    let (codec, y) = (Some(coding.codec.id.to_owned()), y.map(|y| y.name().to_owned()));
    write(kind, &Texture { format: coding.format, width: map.width, height: map.height, levels, codec, y })
}

/// The file of the roughness of all levels.
fn roughness(path: &Path, levels: &[Level]) -> Result<Vec<u8>> {
    let (kind, format) = (kind_of(path)?, format::named("R8_UNORM"));
    let (Some(format), Some(NormalMap { width, height, .. }), true) =
        (format, levels.first().map(|level| &level.map), kind != PNG)
    else {
        return Ok(picture::strip(levels)?);
    };
    let bytes = |level: &Level| level.roughness().iter().map(|it| format.field_of(*it, 8) as u8).collect();
    let levels = levels.iter().map(bytes).collect();
    write(kind, &Texture { format, width: *width, height: *height, levels, codec: None, y: None })
}

/// What was converted.
#[derive(Serialize, schemars::JsonSchema)]
pub struct Summary {
    /// Codec of the output; absent for components.
    #[serde(skip_serializing_if = "Option::is_none")]
    codec: Option<&'static str>,
    /// The format of the input.
    read: String,
    /// The format of the output.
    written: String,
    /// Texels in a row, and rows.
    size: [u32; 2],
    /// Levels of the output.
    levels: usize,
    /// `tangent`, or `object` where z < 0 in more than one texel in a thousand.
    space: &'static str,
    /// Where y points in the output, `up` the image or `down`; null where that is unknown.
    y: Option<&'static str>,
    /// The correlation of the slopes' derivatives from which y was guessed: 1 for y up in the input, -1 for y down. Null where it
    /// was told, and for object space.
    y_correlation: Option<f64>,
    /// Texels without a direction, which became +Z.
    filled: u64,
    /// The least and the greatest length of the others.
    lengths: Option<[f64; 2]>,
    /// Texels with z < 0 beyond noise.
    below_equator: u64,
    /// The mean angle between the vectors of the first level that were read and those that were written, in degrees.
    mean_deg: f64,
    /// The greatest of these angles.
    max_deg: f64,
    #[serde(skip)]
    heat: Option<PathBuf>,
    /// What is lost.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

impl Told for Summary {
    fn lines(&self) -> Vec<String> {
        let [width, height] = self.size;
        let y = match (self.y, self.y_correlation) {
            (Some(y), Some(correlation)) => format!("y {y} (guessed: correlation {correlation:.2})"),
            (Some(y), None) => format!("y {y}"),
            (None, _) => "y unknown".to_owned(),
        };
        let lengths = self
            .lengths
            .map_or_else(String::new, |[least, most]| format!(", lengths {least:.4} to {most:.4}"));
        let filled = format!("{} without a direction (stored as +Z)", self.filled);
        let codec = self.codec.map_or_else(String::new, |codec| format!(" {codec},"));
        let errors =
            format!("{} degrees in the mean, {} at most", degrees(self.mean_deg), degrees(self.max_deg));
        let of_input = format!(
            "{} of {width} x {height} texels, {} space, {y}, {filled}{lengths}, {} below the equator",
            self.read, self.space, self.below_equator
        );
        let of_output =
            format!("{},{codec} {}: off by {errors}", self.written, counted(self.levels as u64, "levels"));
        let heat = self.heat.as_ref().map(|heat| shown(heat.display()));
        let heat = heat.map(|heat| format!("white in {heat}: {} degrees", degrees(self.max_deg)));
        [of_input, of_output].into_iter().chain(heat).collect()
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }
}
