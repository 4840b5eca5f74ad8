//! Accessors of normals and tangents, and of rotations of splats, in glTF files.

use super::{
    Attribute, Beside, CHUNK, Change, Edited, Splice, no_normals, no_splats, not_movable, shortest, span,
};
use crate::format::without_mark;
use crate::gltf::accessor::extents;
use crate::gltf::buffers::file_of;
use crate::gltf::document::{Primitive, check_not_compressed};
use crate::gltf::{FORMAT, File, chunks, load, short};
use crate::{MeshError, Reach, parse_error};
use ::gltf::Semantic::{Normals, Tangents};
use ::gltf::accessor::{DataType, Dimensions};
use base64::Engine;
use base64::engine::general_purpose::{STANDARD, STANDARD_NO_PAD};
use percent_encoding::percent_decode_str;
use serde::Deserialize;
use serde_json::value::RawValue;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

/// The parts of a document that change, as texts, and all uses of accessors by primitives.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Text<'t> {
    #[serde(borrow, default)]
    accessors: Vec<Bounds<'t>>,
    #[serde(borrow, default)]
    buffers: Vec<Resource<'t>>,
    #[serde(borrow, default)]
    images: Vec<Resource<'t>>,
    #[serde(default)]
    meshes: Vec<Uses>,
    #[serde(default)]
    extensions_used: Vec<String>,
}

#[derive(Deserialize)]
struct Bounds<'t> {
    #[serde(borrow)]
    min: Option<&'t RawValue>,
    #[serde(borrow)]
    max: Option<&'t RawValue>,
}

#[derive(Deserialize)]
struct Resource<'t> {
    #[serde(borrow)]
    uri: Option<&'t RawValue>,
}

#[derive(Deserialize)]
struct Uses {
    primitives: Vec<PrimitiveUses>,
}

#[derive(Deserialize)]
struct PrimitiveUses {
    attributes: BTreeMap<String, usize>,
    indices: Option<usize>,
    #[serde(default)]
    targets: Vec<BTreeMap<String, usize>>,
}

impl<'t> Text<'t> {
    fn of(path: &Path, json: &'t [u8]) -> Result<Self, MeshError> {
        serde_json::from_slice(json).map_err(|error| parse_error(path, FORMAT, error))
    }

    fn primitives(&self) -> impl Iterator<Item = &PrimitiveUses> {
        self.meshes.iter().flat_map(|mesh| &mesh.primitives)
    }

    /// The accessors that are something else than these attributes of a primitive.
    fn others(&self, moved: &[&[Attribute]]) -> HashSet<usize> {
        let is_other = |name: &str| !moved.iter().copied().flatten().any(|one| name_of(*one) == name);
        let others = self.primitives().flat_map(|uses| {
            let attributes = uses.attributes.iter().filter(|(name, _)| is_other(name)).map(|(_, at)| *at);
            attributes
                .chain(uses.indices)
                .chain(uses.targets.iter().flat_map(|target| target.values().copied()))
        });
        others.collect()
    }

    /// The files that buffers and images lie in, by their paths from the folder of `path`.
    fn files(&self, path: &Path) -> BTreeMap<PathBuf, Beside> {
        let named = self.buffers.iter().chain(&self.images).filter_map(|resource| file_named(path, resource));
        let beside =
            |(name, source): (PathBuf, PathBuf)| (name.clone(), Beside { name, source, start: None });
        named.filter(|(_, source)| source.is_file()).map(beside).collect()
    }
}

/// The file that a buffer or an image lies in: its path from the folder of `path`, and where it is.
fn file_named(path: &Path, resource: &Resource) -> Option<(PathBuf, PathBuf)> {
    let uri = resource.uri.filter(|uri| !uri.get().starts_with("\"data:"))?;
    let uri: String = serde_json::from_str(uri.get()).ok()?;
    let source = file_of(path, &uri, Reach::Anywhere).ok()?;
    let name = percent_decode_str(&uri).decode_utf8_lossy();
    let parts = Path::new(name.as_ref()).components().filter(|part| *part != Component::CurDir);
    Some((parts.collect(), source))
}

/// The files that a document names, as far as they are there.
pub(super) fn sources(path: &Path, bytes: &[u8]) -> Result<Vec<PathBuf>, MeshError> {
    let (json, _) = chunks(path, bytes)?;
    Ok(Text::of(path, &json)?.files(path).into_values().map(|file| file.source).collect())
}

/// A part of the file, and the bytes that replace it.
type Patch = (Range<usize>, Vec<u8>);

/// The name of an attribute in a document.
fn name_of(attribute: Attribute) -> &'static str {
    match attribute {
        Attribute::Normal => "NORMAL",
        Attribute::Tangent => "TANGENT",
        Attribute::Rotation => "KHR_gaussian_splatting:ROTATION",
    }
}

/// The accessor of an attribute of a primitive, and the dimension that it has to have.
fn accessor_of(primitive: &Primitive, attribute: Attribute) -> Option<(u32, Dimensions)> {
    let (index, dimensions) = match attribute {
        Attribute::Normal => (primitive.get(&Normals), Dimensions::Vec3),
        Attribute::Tangent => (primitive.get(&Tangents), Dimensions::Vec4),
        Attribute::Rotation => (primitive.rotations(), Dimensions::Vec4),
    };
    Some((index?, dimensions))
}

/// Moves the vectors of all primitives, those of an accessor once.
pub(super) fn edit(
    path: &Path,
    bytes: &[u8],
    reach: Reach,
    mut change: Change<'_>,
) -> Result<Edited, MeshError> {
    let (json, chunk) = chunks(path, bytes)?;
    let mut text = Text::of(path, &json)?;
    check_not_compressed(path, &text.extensions_used)?;
    let groups = change.groups();
    let others = text.others(groups);
    let with_targets = text.primitives().filter(|uses| !uses.targets.is_empty()).count();
    text.meshes = Vec::new();
    let first = groups[0][0];
    let read: &[_] = if first == Attribute::Rotation { &[] } else { &[Normals, Tangents] };
    let file = load(path, bytes, reach, read)?;
    let stores = stores(path, &text);
    let plan = Plan::of(&file, &stores, &others, groups)?;
    let warnings = warnings(&file, first, with_targets);
    let meshes = file.meshes.iter().map(|mesh| mesh.name.as_deref().map(short)).collect();
    let moved: HashSet<usize> = plan.places.values().map(|place| place.store).collect();
    let mut contents = vec![Vec::new(); stores.len()];
    for (content, store) in file.buffers.into_iter().zip(&stores).filter(|(_, store)| moved.contains(store)) {
        if contents[*store].is_empty() {
            contents[*store] = Rc::unwrap_or_clone(content).into_owned();
        }
    }
    plan.run(&mut contents, &mut change);
    let mut patches = bounds(path, bytes, &text, &plan, &contents)?;
    let mut files = text.files(path);
    let mut binary = None;
    for (buffer, content) in contents.into_iter().enumerate().filter(|(_, content)| !content.is_empty()) {
        let resource = &text.buffers[buffer];
        match (resource.uri, file_named(path, resource).and_then(|(name, _)| files.get_mut(&name))) {
            (Some(_), Some(file)) => file.start = Some(content),
            (Some(uri), None) => patches.push(data_uri(path, bytes, uri, &content)?),
            (None, _) => binary = chunk.as_deref().zip(Some(content)),
        }
    }
    let bytes = spliced(path, bytes, &json, patches, binary)?;
    Ok(Edited { bytes, meshes, files: files.into_values().collect(), warnings })
}

/// Vectors of the file that are not moved, in words.
fn warnings(file: &File, first: Attribute, with_targets: usize) -> Vec<String> {
    let is_without = |primitive| accessor_of(primitive, first).is_none();
    let without = file.primitives().filter(|(.., primitive)| is_without(primitive)).count();
    let lacking = if first == Attribute::Rotation { "no splats" } else { "no normals" };
    let words = [(without, lacking), (with_targets, "morph targets, which are left as they are")];
    let words = words.into_iter().filter(|(count, _)| *count > 0);
    words.map(|(count, words)| format!("primitives that have {words}: {count}")).collect()
}

/// For each buffer the first one that lies in a file of the same name: itself, where none does.
fn stores(path: &Path, text: &Text) -> Vec<usize> {
    let mut firsts = HashMap::new();
    let store = |(buffer, resource)| match file_named(path, resource) {
        Some((name, _)) => *firsts.entry(name).or_insert(buffer),
        None => buffer,
    };
    text.buffers.iter().enumerate().map(store).collect()
}

/// The place of the floats of an accessor.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Place {
    /// The first buffer in the same file.
    store: usize,
    start: usize,
    stride: usize,
    count: usize,
    /// Floats of an element.
    floats: usize,
}

impl Place {
    /// The place of vectors of this dimension that can be moved where they are.
    fn of(file: &File, stores: &[usize], index: u32, dimensions: Dimensions) -> Result<Self, MeshError> {
        let accessor = file.accessor(index)?;
        let refused = |reason, remedy| not_movable(file.path, format!("accessor {index} {reason}"), remedy);
        if accessor.sparse().is_some() {
            return Err(refused("is sparse", "export the mesh without sparse accessors"));
        }
        if accessor.data_type() != DataType::F32 {
            return Err(refused("has integers, quantised already", "take the mesh before it is quantised"));
        }
        if accessor.dimensions() != dimensions {
            return Err(file.error(format!("accessor {index} does not have {dimensions:?}")));
        }
        file.check_extents(&accessor)?;
        let view = accessor.view().ok_or_else(|| refused("has no bytes", "export the mesh with normals"))?;
        Ok(Self {
            store: stores[view.buffer().index()],
            start: view.offset() + accessor.offset(),
            stride: view.stride().unwrap_or(accessor.size()),
            count: accessor.count(),
            floats: accessor.size() / 4,
        })
    }

    /// The bytes of an element, which lies in the contents.
    fn element(&self, row: usize) -> Range<usize> {
        let start = self.start + row * self.stride;
        start..start + 4 * self.floats
    }

    /// The floats of an element.
    fn floats<'c>(&self, contents: &'c [Vec<u8>], row: usize) -> impl Iterator<Item = f32> + use<'c> {
        let bytes = contents[self.store][self.element(row)].chunks_exact(4);
        bytes.map(|float| f32::from_le_bytes([float[0], float[1], float[2], float[3]]))
    }
}

/// Vectors of a mesh that are moved at once: at one place or, for frames, at two.
struct Job {
    mesh: usize,
    attribute: Attribute,
    places: Vec<Place>,
}

/// All that is moved, once each.
struct Plan {
    jobs: Vec<Job>,
    /// The places of accessors.
    places: BTreeMap<usize, Place>,
}

impl Plan {
    /// Finds what is moved, and checks that nothing else has these bytes.
    fn of(
        file: &File,
        stores: &[usize],
        others: &HashSet<usize>,
        groups: &[&[Attribute]],
    ) -> Result<Self, MeshError> {
        let mut plan = Self { jobs: Vec::new(), places: BTreeMap::new() };
        let (mut seen, mut taken) = (HashSet::new(), Taken(vec![Vec::new(); stores.len()]));
        for (mesh, at, primitive) in file.primitives() {
            for group in groups {
                let of_frames = group.len() > 1;
                let accessors = group.iter().map(|attribute| accessor_of(primitive, *attribute));
                let Some(accessors) = accessors.collect::<Option<Vec<_>>>() else {
                    if of_frames {
                        return Err(file.no_tangents(mesh, at));
                    }
                    continue;
                };
                if of_frames {
                    file.check_counts(primitive, [Normals, Tangents])?;
                }
                let mut places = Vec::new();
                for (index, dimensions) in &accessors {
                    let place = Place::of(file, stores, *index, *dimensions)?;
                    plan.places.insert(*index as usize, place);
                    places.push(place);
                }
                let is_new = seen.insert(places.clone());
                for (place, (index, _)) in places.iter().zip(&accessors) {
                    if others.contains(&(*index as usize)) || (is_new && !taken.take(place)) {
                        return Err(shared(file, *index as usize));
                    }
                }
                if is_new {
                    plan.jobs.push(Job { mesh, attribute: group[0], places });
                }
            }
        }
        let first = groups[0][0];
        if !plan.jobs.iter().any(|job| job.attribute == first) {
            let without = if first == Attribute::Rotation { no_splats } else { no_normals };
            return Err(without(file.path));
        }
        plan.check_others(file, stores, &taken)?;
        Ok(plan)
    }

    /// Refuses other accessors with bytes that are moved.
    fn check_others(&self, file: &File, stores: &[usize], taken: &Taken) -> Result<(), MeshError> {
        /// An element takes a byte at least. Accessors may share some.
        const SHARED: usize = 4;
        let mut elements = 0_usize;
        for accessor in file.document.accessors().filter(|one| !self.places.contains_key(&one.index())) {
            for (view, offset, count, size) in extents(&accessor) {
                let words = &taken.0[stores[view.buffer().index()]];
                elements = elements.saturating_add(if words.is_empty() { 0 } else { count });
                file.check_total(elements, SHARED * file.size, "elements of accessors")?;
                let start = view.offset().saturating_add(offset);
                let mut own = self::words(start, view.stride().unwrap_or(size), size, count);
                if own.by_ref().take_while(|word| *word < words.len()).any(|word| words[word]) {
                    return Err(shared(file, accessor.index()));
                }
            }
        }
        Ok(())
    }

    fn run(&self, contents: &mut [Vec<u8>], change: &mut Change<'_>) {
        for Job { mesh, attribute, places } in &self.jobs {
            match change {
                Change::Vectors(change) => {
                    run(places, contents, &mut |vectors| change(*mesh, *attribute, vectors));
                }
                Change::Frames(change) => run(places, contents, &mut |frames| change(*mesh, frames)),
                Change::Rotations(change) => {
                    run(places, contents, &mut |rotations| change(*mesh, rotations));
                }
            }
        }
    }
}

/// The error of an accessor whose bytes are vectors that are moved, and something else.
fn shared(file: &File, index: usize) -> MeshError {
    let reason = format!("accessor {index} shares bytes with another attribute");
    not_movable(file.path, reason, "export the mesh with an accessor of its own for each attribute")
}

/// The words of four bytes that are moved, for each of the buffers.
struct Taken(Vec<Vec<bool>>);

impl Taken {
    /// Takes the words of a place; false where some are taken already.
    fn take(&mut self, place: &Place) -> bool {
        let words = &mut self.0[place.store];
        let end = place.element(place.count - 1).end.div_ceil(4);
        words.resize(words.len().max(end), false);
        let mut own = self::words(place.start, place.stride, 4 * place.floats, place.count);
        own.all(|word| !std::mem::replace(&mut words[word], true))
    }
}

/// The words of four bytes that so many elements touch.
fn words(start: usize, stride: usize, size: usize, count: usize) -> impl Iterator<Item = usize> {
    let starts = (0..count).map(move |row| row.saturating_mul(stride).saturating_add(start));
    starts.flat_map(move |start| start / 4..start.saturating_add(size).div_ceil(4))
}

/// Moves vectors, or frames of the vectors at two places. The fourth float of tangents is written with frames alone.
fn run<const N: usize>(places: &[Place], contents: &mut [Vec<u8>], change: &mut dyn FnMut(&mut [[f32; N]])) {
    let count = places.iter().map(|place| place.count).min().unwrap_or(0);
    for first in (0..count).step_by(CHUNK) {
        let rows = first..count.min(first + CHUNK);
        let mut elements = vec![[0.0; N]; rows.len()];
        for (row, element) in rows.clone().zip(&mut elements) {
            let floats = places.iter().flat_map(|place| place.floats(contents, row));
            element.iter_mut().zip(floats).for_each(|(to, from)| *to = from);
        }
        change(&mut elements);
        for (row, element) in rows.zip(&elements) {
            let mut moved = element.iter();
            for place in places {
                let floats = contents[place.store][place.element(row)].chunks_exact_mut(4);
                floats.zip(moved.by_ref()).for_each(|(to, from)| to.copy_from_slice(&from.to_le_bytes()));
            }
        }
    }
}

/// The least and greatest components of what was moved, where the document tells others.
fn bounds(
    path: &Path,
    bytes: &[u8],
    text: &Text,
    plan: &Plan,
    contents: &[Vec<u8>],
) -> Result<Vec<Patch>, MeshError> {
    let mut patches = Vec::new();
    for (index, place) in &plan.places {
        let Bounds { min, max } = &text.accessors[*index];
        for (told, is_min) in [(min, true), (max, false)] {
            let Some(told) = told else { continue };
            let pick = if is_min { f32::min } else { f32::max };
            let told: Vec<&RawValue> =
                serde_json::from_str(told.get()).map_err(|error| parse_error(path, FORMAT, error))?;
            for (component, told) in told.into_iter().take(place.floats).enumerate() {
                let all = (0..place.count).filter_map(|row| place.floats(contents, row).nth(component));
                let bound = all.filter(|value| value.is_finite()).reduce(pick);
                let is_told = |bound: &f32| told.get().parse() == Ok(*bound);
                let place = span(bytes, told.get().as_bytes());
                let patch = place.zip(bound.filter(|bound| !is_told(bound)));
                patches.extend(patch.map(|(place, bound)| (place, shortest(bound).into_bytes())));
            }
        }
    }
    Ok(patches)
}

/// A data URI with other contents, padded as before.
fn data_uri(path: &Path, bytes: &[u8], uri: &RawValue, content: &[u8]) -> Result<Patch, MeshError> {
    const MARK: &str = ";base64,";
    let text = uri.get();
    let place = text.find(MARK).zip(span(bytes, text.as_bytes()));
    let place = place.map(|(mark, whole)| whole.start + mark + MARK.len()..whole.end - 1);
    let engine = if text.ends_with("=\"") { STANDARD } else { STANDARD_NO_PAD };
    let place = place.ok_or_else(|| parse_error(path, FORMAT, "the head of a data URI is escaped"))?;
    Ok((place, engine.encode(content).into_bytes()))
}

/// The file with its patches and its binary chunk; the lengths in a GLB are those of the new chunks.
fn spliced(
    path: &Path,
    bytes: &[u8],
    json: &[u8],
    mut patches: Vec<Patch>,
    binary: Option<(&[u8], Vec<u8>)>,
) -> Result<Vec<u8>, MeshError> {
    let mark = bytes.len() - without_mark(bytes).len();
    if let Some(json) = span(bytes, json).filter(|_| bytes[mark..].starts_with(b"glTF")) {
        let lengths = glb_lengths(bytes, mark, json, &patches);
        patches.extend(lengths.ok_or_else(|| parse_error(path, FORMAT, "it is too long for a GLB"))?);
    }
    patches.extend(binary.and_then(|(chunk, content)| Some((span(bytes, chunk)?, content))));
    patches.sort_by_key(|(part, _)| part.start);
    let mut splice = Splice::new(path, bytes)?;
    patches.into_iter().for_each(|(part, with)| splice.replace(part, &with));
    Ok(splice.finish())
}

/// The padding of a JSON chunk that patches make longer or shorter, and the lengths in the headers.
fn glb_lengths(bytes: &[u8], mark: usize, json: Range<usize>, patches: &[Patch]) -> Option<Vec<Patch>> {
    let written = patches.iter().map(|(_, with)| with.len()).sum::<usize>();
    let replaced = patches.iter().map(|(part, _)| part.len()).sum::<usize>();
    if written == replaced {
        return Some(Vec::new());
    }
    let end = json.start + bytes[json.clone()].trim_ascii_end().len();
    let text = end - json.start + written - replaced;
    let length = text.next_multiple_of(4);
    let total = <[u8; 4]>::try_from(bytes.get(mark + 8..mark + 12)?).ok()?;
    let total = (u32::from_le_bytes(total) as usize + length).checked_sub(json.len())?;
    let field = |at: usize, length: usize| {
        let length = u32::try_from(length).ok()?.to_le_bytes().to_vec();
        Some((mark + at..mark + at + 4, length))
    };
    Some(vec![field(8, total)?, field(12, length)?, (end..json.end, vec![b' '; length - text])])
}
