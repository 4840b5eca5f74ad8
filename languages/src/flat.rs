//! The families' files in GLSL without any include: each with only what it needs of the others.

use crate::print::{ARITH, Printer};
use crate::syntax::{Families, File, Item, Part};
use crate::{ALL, Edition, Error, Language, Library};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

impl Library {
    /// The families' files in GLSL for loaders without `#include`, by name: `oct.glsl`. Each has what its family needs of the
    /// others, without the comments of those. Several files may stand in one shader, in any order.
    ///
    /// # Errors
    /// [`Error::Reserved`].
    pub fn flat(&self) -> Result<BTreeMap<String, String>, Error> {
        let is_family = |file: &&File| ![ARITH, ALL].contains(&file.name.as_str());
        let families: Vec<&File> = self.files.iter().filter(is_family).collect();
        let needs: Vec<BTreeSet<&str>> = families
            .iter()
            .map(|file| {
                let own = file.items.iter().filter_map(|item| item.kind.name()).collect();
                self.closure(own, Language::Glsl, Edition::Plain)
            })
            .collect();
        let parts = self.parts(&needs);
        let text = |(index, family): (usize, &File)| {
            let needed = parts.iter().filter(|part| part.families.1.contains(&index));
            let mut printer = Printer::new(Language::Glsl, Edition::Plain, &self.declared);
            printer.flat(family, self.items(), needed)?;
            Ok((family.name.clone(), printer.finish()))
        };
        families.into_iter().enumerate().map(text).collect()
    }

    /// All that families need, in parts, given what each needs. What half of them need goes to all, in one part: it takes fewer
    /// lines than guards would.
    fn parts(&self, needs: &[BTreeSet<&str>]) -> Vec<Part<'_>> {
        let mut parts: BTreeMap<Families, Vec<(&File, &Item)>> = BTreeMap::new();
        for file in &self.files {
            for item in &file.items {
                let Some(name) = item.kind.name() else { continue };
                let all = 0..needs.len();
                let users: Vec<usize> = all.clone().filter(|index| needs[*index].contains(name)).collect();
                let is_common = 2 * users.len() >= needs.len();
                let families = if is_common { all.collect() } else { users };
                parts.entry((Reverse(families.len()), families)).or_default().push((file, item));
            }
        }
        parts.into_iter().map(|(families, items)| Part { families, items }).collect()
    }
}
