use super::figures::Rendering;
use super::many::{Failed, check_beside, pairs};
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
use unitvec_vulkan::Device;

#[derive(Args)]
pub struct Arguments {
    /// Codec of vectors, or format of other software, as `unitvec codecs` lists them; may be given again.
    #[arg(long, visible_alias = "format", value_name = "ID,...", value_delimiter = ',', required = true)]
    codec: Vec<String>,
    /// Direction from the mesh to the eye, in its own axes; the worst of 26 if not given.
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    view: Option<[f32; 3]>,
    /// Page to write; or a folder that exists, which gets NAME.html for each mesh.
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
    /// Mesh file with faces: .obj, .ply, .gltf, .glb; or a folder, whose meshes are taken.
    #[arg(required = true)]
    mesh: Vec<PathBuf>,
}

fn direction(text: &str) -> std::result::Result<[f32; 3], String> {
    let axes = text.split(',').map(|axis| axis.trim().parse().ok()).collect::<Option<Vec<f32>>>();
    let axes = axes.and_then(|axes| <[f32; 3]>::try_from(axes).ok());
    axes.filter(|axes| unitvec_mesh::has_direction(*axes)).ok_or_else(|| "not a direction as 1,0.5,-2".into())
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let vulkan = &arguments.rendering.vulkan;
    vulkan.refuse_modules()?;
    let codecs = arguments.codec.iter().map(|id| codec(id)).collect::<Result<Vec<_>>>()?;
    let pairs = pairs(&arguments.mesh, &arguments.output, is_mesh, Some("html"))?;
    arguments.json.spare(pairs.iter().flat_map(|(mesh, page)| [mesh, page]).chain(&arguments.ply))?;
    arguments.ply.iter().try_for_each(|ply| check_beside(ply, &pairs, true))?;
    // What cannot be written is told before the work.
    let pages = pairs.iter().map(|(_, page)| Ok(Output::create(page)?)).collect::<Result<Vec<_>>>()?;
    let is_page = pages.iter().any(Output::is_stdout);
    if is_page && arguments.json.is_to_stdout() {
        return Err(Error::Usage("the page and the JSON cannot both go to the standard output".to_owned()));
    }
    let (mut meter, mut computed) = (Meter::new(codecs.clone())?, Vec::new());
    let (mut failed, mut measured) = (Failed::of(pairs.len()), Vec::new());
    for ((mesh, name), page) in pairs.iter().zip(pages) {
        let kind = Kind { reach: arguments.buffers.reach(), ..Kind::default() };
        let Some(is_computed) = failed.unless(measure(&mut meter, mesh, kind))? else { continue };
        computed.extend(is_computed.then(|| FileName::from(mesh.as_path())));
        measured.push((mesh, name, page));
    }
    if measured.is_empty() {
        return failed.end().map(|()| ExitCode::SUCCESS);
    }
    let errors = Report { computed, ..meter.report() };
    let device = vulkan.device_for_graphics()?;
    let mut told = String::new();
    for (mesh, name, page) in measured {
        if let Some(at) = failed.unless(one(arguments, &codecs, &device, &errors, mesh, page))? {
            told += &format!("compare: {}, seen from {at}\n", name.display());
        }
    }
    match is_page {
        true => arguments.json.write(&errors)?,
        false => drop(arguments.json.write_or_print(&errors, || told)?),
    }
    let status = status_after_validation(&close(device).1);
    failed.end()?;
    Ok(status)
}

/// Writes the page of a mesh. Returns where it is seen from.
fn one(
    arguments: &Arguments,
    codecs: &[&'static AnyCodec],
    device: &Arc<Device>,
    errors: &Report,
    mesh: &Path,
    page: Output,
) -> Result<String> {
    let shapes = Input::open(mesh)?.parse(parse_shapes, arguments.buffers.reach())?;
    let live = Live::new(None, "{spinner} pictures, {elapsed}", true);
    let Rendering { samples, source, .. } = arguments.rendering;
    let (maps, told) = normal_maps(&shapes);
    let codecs = codecs.to_vec();
    let options = Options { codecs, view: arguments.view, side: arguments.side, samples, source, maps };
    let compared = compare(device, &shapes, &options)?;
    live.finish();
    let contents = Contents {
        file: mesh.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        compared: &compared,
        is_worst: arguments.view.is_none(),
        device: device.info(),
        errors: rows(errors, mesh),
        notes: [notes(errors, mesh), told, coarseness(compared.fineness)].concat(),
    };
    super::write_output(page, html(&contents)?.as_bytes())?;
    if let (Some(path), Some(first)) = (&arguments.ply, compared.codecs.first()) {
        write_file(path, &ply(&shapes, first))?;
    }
    Ok(compared.view.map(|axis| axis.to_string()).join(","))
}

/// A codec whose errors are angles between vectors.
fn codec(id: &str) -> Result<&'static AnyCodec> {
    let codec = find_any(id)?;
    match codec.element == Element::Vector && codec.measure() == Measure::Angle {
        true => Ok(codec),
        false => Err(Error::Usage(format!("{id} is not for directions, and `compare` shows normals"))),
    }
}

/// Measures a mesh's vectors, as `unitvec error` does. Returns whether they are computed.
fn measure(meter: &mut Meter, mesh: &Path, kind: Kind) -> Result<bool> {
    let mut elements = Elements::open(mesh, Element::Vector, kind)?;
    meter.measure(&mut Cpu, Named::new(mesh, &mut elements.floats), &mut |_| ())?;
    Ok(elements.are_computed())
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

fn rows(report: &Report, mesh: &Path) -> Vec<[String; 7]> {
    let row = |row: &Row| {
        let sizes = row.errors.as_ref().map(|errors| errors.sizes.map(degrees));
        let [mean, median, p99, max] = sizes.unwrap_or([(); 4].map(|()| "-".to_owned()));
        [row.id.to_owned(), row.bits.to_string(), row.count.to_string(), mean, median, p99, max]
    };
    of(report, mesh).map(row).collect()
}

/// The rows of a mesh in the report of all.
fn of<'a>(report: &'a Report, mesh: &Path) -> impl Iterator<Item = &'a Row> {
    let name = FileName::from(mesh);
    report.rows.iter().filter(move |row| row.file.as_ref() == Some(&name))
}

fn notes(report: &Report, mesh: &Path) -> Vec<String> {
    let left_out = of(report, mesh).next().map_or(0, |row| row.left_out);
    let is_computed = report.computed.contains(&FileName::from(mesh));
    let notes = [
        (is_computed, "The file lacks normals: they are computed from its faces.".to_owned()),
        (left_out > 0, format!("Vectors left out, since they have no direction: {left_out}.")),
    ];
    notes.into_iter().filter(|(is_so, _)| *is_so).map(|(_, words)| words).collect()
}
