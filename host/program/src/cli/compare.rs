use super::figures::Rendering;
use super::run::{Json, Live, close};
use super::{Buffers, degrees, is_mesh, status_after_validation};
use clap::Args;
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::rc::Rc;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Element, Measure, find_any};
use unitvec_files::{Output, write_file};
use unitvec_host::input::{Elements, FileName, Input, Kind};
use unitvec_host::loss::{Meter, Report, Row};
use unitvec_host::stream::Named;
use unitvec_host::{Error, Result};
use unitvec_mesh::{NormalTexture, Shape, parse_shapes};
use unitvec_render::figures::detail::NormalMap;
use unitvec_render::figures::model::{Options, compare, ply};
use unitvec_render::report::model::{Contents, html};
use unitvec_run::backend::Cpu;

#[derive(Args)]
pub struct Arguments {
    /// Codec of vectors, or format of other software, as `unitvec codecs` lists them; may be given again.
    #[arg(long, visible_alias = "format", value_name = "ID,...", value_delimiter = ',', required = true)]
    codec: Vec<String>,
    /// Direction from the mesh to the eye, in its own axes; the worst of 26 if not given.
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    view: Option<[f32; 3]>,
    /// Page to write.
    #[arg(short, long, value_name = "FILE", alias = "out", default_value = "compare.html")]
    output: PathBuf,
    /// Write the mesh with the first codec's errors as colours of the vertices, and in degrees as `quality`, too.
    #[arg(long, value_name = "FILE")]
    ply: Option<PathBuf>,
    /// Width and height of a picture.
    #[arg(long, value_name = "PIXELS", default_value_t = 480, value_parser = clap::value_parser!(u32).range(64..=2048))]
    side: u32,
    #[command(flatten)]
    buffers: Buffers,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    rendering: Rendering,
    /// Mesh file with faces: .obj, .ply, .gltf, .glb. Normal maps of glTF materials are shown.
    mesh: PathBuf,
}

fn direction(text: &str) -> std::result::Result<[f32; 3], String> {
    let axes = text.split(',').map(|axis| axis.trim().parse().ok()).collect::<Option<Vec<f32>>>();
    let axes = axes.and_then(|axes| <[f32; 3]>::try_from(axes).ok());
    axes.filter(|axes| unitvec_mesh::has_direction(*axes)).ok_or_else(|| "not a direction as 1,0.5,-2".into())
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let Arguments { mesh, output, rendering, .. } = arguments;
    rendering.vulkan.refuse_modules()?;
    let codecs = arguments.codec.iter().map(|id| codec(id)).collect::<Result<Vec<_>>>()?;
    // What cannot be written is told before the work.
    if is_mesh(output) {
        return Err(Error::Usage(format!(
            "{} is the name of a mesh; give the page another",
            output.display()
        )));
    }
    arguments.json.spare([mesh, output].into_iter().chain(&arguments.ply))?;
    let page = Output::create(output)?;
    let is_page = page.is_stdout();
    if is_page && arguments.json.is_to_stdout() {
        return Err(Error::Usage("the page and the JSON cannot both go to the standard output".to_owned()));
    }
    let reach = arguments.buffers.reach();
    let shapes = Input::open(mesh)?.parse(parse_shapes, reach)?;
    let errors = errors(mesh, &codecs, Kind { reach, ..Kind::default() })?;
    let live = Live::new(None, "{spinner} pictures, {elapsed}", true);
    let device = rendering.vulkan.device_for_graphics()?;
    let Rendering { samples, source, .. } = *rendering;
    let (maps, told) = normal_maps(&shapes);
    let options = Options { codecs, view: arguments.view, side: arguments.side, samples, source, maps };
    let compared = compare(&device, &shapes, &options)?;
    live.finish();
    let contents = Contents {
        file: mesh.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        compared: &compared,
        is_worst: arguments.view.is_none(),
        device: device.info(),
        errors: rows(&errors),
        notes: [notes(&errors), told, coarseness(compared.fineness)].concat(),
    };
    super::write_output(page, html(&contents)?.as_bytes())?;
    if let (Some(path), Some(first)) = (&arguments.ply, compared.codecs.first()) {
        write_file(path, &ply(&shapes, first))?;
    }
    let at = compared.view.map(|axis| axis.to_string()).join(",");
    match is_page {
        true => arguments.json.write(&errors)?,
        false => {
            let words = || format!("compare: {}, seen from {at}\n", output.display());
            arguments.json.write_or_print(&errors, words)?;
        }
    }
    Ok(status_after_validation(&close(device).1))
}

/// A codec whose errors are angles between vectors.
fn codec(id: &str) -> Result<&'static AnyCodec> {
    let codec = find_any(id)?;
    match codec.element == Element::Vector && codec.measure() == Measure::Angle {
        true => Ok(codec),
        false => Err(Error::Usage(format!("{id} is not for directions, and `compare` shows normals"))),
    }
}

/// The errors of the file's vectors, as `unitvec error` measures them.
fn errors(mesh: &Path, codecs: &[&'static AnyCodec], kind: Kind) -> Result<Report> {
    let mut meter = Meter::new(codecs.to_vec())?;
    let mut elements = Elements::open(mesh, Element::Vector, kind)?;
    meter.measure(&mut Cpu, Named::new(mesh, &mut elements.floats), &mut |_| ())?;
    let is_computed = elements.parts.is_some_and(|parts| parts.iter().any(|part| part.computed));
    let computed = is_computed.then(|| FileName::from(mesh)).into_iter().collect();
    Ok(Report { computed, ..meter.report() })
}

/// The normal map of each shape that has one, and what is to be told of them.
fn normal_maps(shapes: &[Shape]) -> (Vec<Option<Rc<NormalMap>>>, Vec<String>) {
    let mut told = BTreeSet::new();
    let mut decode = |texture: &NormalTexture| {
        let bytes = texture.picture.as_ref().map_err(Clone::clone);
        let source = bytes.and_then(|bytes| {
            let source = unitvec_texture::read(Path::new(&texture.name), bytes, None);
            source.map_err(|error| error.to_string())
        });
        told.insert(match &source {
            Ok(_) => format!("The mesh is shown with its {}, whose vectors are not in codes.", texture.name),
            Err(error) => format!("The {} is not shown: {error}.", texture.name),
        });
        let map = source.ok()?.map;
        let size = [map.width, map.height];
        Some(Rc::new(NormalMap { size, texels: map.vectors, scale: texture.scale }))
    };
    // Shapes of one material share its texture.
    let mut decoded = HashMap::new();
    let mut map = |texture: &Arc<NormalTexture>| {
        decoded.entry(Arc::as_ptr(texture)).or_insert_with(|| decode(texture)).clone()
    };
    let maps = shapes.iter().map(|shape| shape.normal_map.as_ref().and_then(&mut map)).collect();
    (maps, told.into_iter().collect())
}

/// What is to be told of normal maps that are shown less finely than they are.
fn coarseness(fineness: f32) -> Vec<String> {
    let words = if fineness >= 1.0 {
        return Vec::new();
    } else if fineness > 0.0 {
        format!("There are too many texels: normal maps are shown at {fineness} of those along an edge.")
    } else {
        "There are too many triangles to divide: normal maps are shown at vertices alone.".to_owned()
    };
    vec![words]
}

fn rows(report: &Report) -> Vec<[String; 7]> {
    let row = |row: &Row| {
        let sizes = row.errors.as_ref().map(|errors| errors.sizes.map(degrees));
        let [mean, median, p99, max] = sizes.unwrap_or([(); 4].map(|()| "-".to_owned()));
        [row.id.to_owned(), row.bits.to_string(), row.count.to_string(), mean, median, p99, max]
    };
    report.rows.iter().map(row).collect()
}

fn notes(report: &Report) -> Vec<String> {
    let left_out = report.rows.first().map_or(0, |row| row.left_out);
    let notes = [
        (!report.computed.is_empty(), "The file lacks normals: they are computed from its faces.".to_owned()),
        (left_out > 0, format!("Vectors left out, since they have no direction: {left_out}.")),
    ];
    notes.into_iter().filter(|(is_so, _)| *is_so).map(|(_, words)| words).collect()
}
