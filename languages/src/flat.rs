//! The families' files in GLSL without any include: each with only what it needs of the others; and the parts in which texts
//! share declarations.

use crate::print::{ARITH, Printer};
use crate::syntax::{File, Item, Part, Users};
use crate::{ALL, Edition, Error, Language, Library};
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};

impl Library {
    /// The families' files in GLSL for loaders without `#include`, by name: `oct.glsl`. Each has what its family needs of the
    /// others, without the comments of those. Several files may stand in one shader, in any order.
    ///
    /// # Errors
    /// [`Error::Reserved`].
    pub fn flat(&self) -> Result<BTreeMap<String, String>, Error> {
        let is_family = |file: &&File| ![ARITH, ALL].contains(&file.name.as_str());
        let families: Vec<&File> = self.files.iter().filter(is_family).collect();
        let user =
            |name: &str| families.iter().position(|file| self.declared.homes.get(name) == Some(&file.name));
        // What half of the families need goes to all, in one part: it takes fewer lines than guards would.
        let common = families.len().div_ceil(2);
        let parts = self.parts(Language::Glsl, Edition::Plain, families.len(), common, user);
        let text = |(index, family): (usize, &File)| {
            let needed = parts.iter().filter(|part| part.is_for(index));
            let mut printer = Printer::new(Language::Glsl, Edition::Plain, &self.declared);
            printer.flat(family, &self.files[0], needed)?;
            Ok((family.name.clone(), printer.finish()))
        };
        families.into_iter().enumerate().map(text).collect()
    }

    /// All declarations in parts: those that the same users need, of `count` users. `user` says which user a name belongs to.
    /// What at least `common` users need goes to all, in one part.
    pub(crate) fn parts(
        &self,
        language: Language,
        edition: Edition,
        count: usize,
        common: usize,
        user: impl Fn(&str) -> Option<usize>,
    ) -> Vec<Part<'_>> {
        let branch = |condition: &_| language.written().branch(edition, condition);
        let mut users: HashMap<&str, Vec<bool>> = HashMap::new();
        // Names are declared before they are used: an item's users are known before those of what it needs.
        for (name, item) in self.items().rev().filter_map(|(_, item)| Some((item.kind.name()?, item))) {
            let mut own = users.remove(name).unwrap_or_else(|| vec![false; count]);
            user(name).and_then(|user| own.get_mut(user)).into_iter().for_each(|own| *own = true);
            for used in item.kind.names_used(&branch) {
                let theirs = users.entry(used).or_insert_with(|| vec![false; count]);
                theirs.iter_mut().zip(&own).for_each(|(theirs, own)| *theirs |= own);
            }
            users.insert(name, own);
        }
        let mut parts: BTreeMap<Users, Vec<(&File, &Item)>> = BTreeMap::new();
        for (file, item) in self.items() {
            let Some(own) = item.kind.name().and_then(|name| users.get(name)) else { continue };
            let number = own.iter().filter(|needs| **needs).count();
            let key = if number >= common { (count, vec![true; count]) } else { (number, own.clone()) };
            parts.entry(Reverse(key)).or_default().push((file, item));
        }
        parts.into_iter().map(|(users, items)| Part { users, items }).collect()
    }
}
