//! `unitvec schema`: the JSON schemas of what the commands write with `--json`.

use super::{choose, print, snap, summary, texture, to_json};
use clap::Args;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use std::process::ExitCode;
use unitvec_catalogue::AnyCodec;
use unitvec_host::{Error, Result, loss};
use unitvec_run::conform;

#[derive(Args)]
pub struct Arguments {
    /// Command with --json, such as `choose` or `conform pipeline`. If none is given, they are listed.
    command: Vec<String>,
}

/// A command, and the schema of its JSON.
type Described = (&'static str, fn() -> Schema);

const SCHEMAS: &[Described] = &[
    ("codecs", of::<Vec<AnyCodec>>),
    ("encode", of::<summary::Reports>),
    ("decode", of::<summary::Reports>),
    ("normals", of::<summary::Reports>),
    ("snap", of::<summary::Reports<snap::Summary>>),
    ("texture", of::<summary::Reports<texture::Summary>>),
    ("write", of::<summary::Reports>),
    ("error", of::<loss::Report>),
    #[cfg(feature = "render")]
    ("compare", of::<loss::Report>),
    ("choose", of::<choose::Report>),
    #[cfg(feature = "lab")]
    ("accuracy", of::<super::accuracy::Report>),
    #[cfg(feature = "lab")]
    ("bench", of::<unitvec_choose::costs::Report>),
    #[cfg(feature = "lab")]
    ("bench device", of::<unitvec_choose::costs::Report>),
    #[cfg(feature = "lab")]
    ("bench compiler", of::<unitvec_choose::costs::Report>),
    ("conform", of::<conform::Report>),
    ("conform kernels", of::<conform::Report>),
    #[cfg(feature = "render")]
    ("conform pipeline", of::<unitvec_render::conform::Report>),
    #[cfg(feature = "lab")]
    ("conform imprecise", of::<super::imprecise::Report>),
];

/// The schema of a type as it is written: an option that is always there, if only as null, is required.
fn of<T: JsonSchema>() -> Schema {
    SchemaSettings::default().for_serialize().into_generator().into_root_schema_for::<T>()
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let command = arguments.command.join(" ");
    let names = || SCHEMAS.iter().map(|(name, _)| *name).collect::<Vec<_>>();
    if command.is_empty() {
        return print(&(names().join("\n") + "\n"));
    }
    match SCHEMAS.iter().find(|(name, _)| *name == command) {
        Some((_, schema)) => print(&to_json(&schema())),
        None => Err(Error::Usage(format!("`{command}` writes no JSON; these do: {}", names().join(", ")))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Command, CommandFactory};
    use std::collections::BTreeSet;

    /// The commands with the option `--json`.
    fn with_json(command: &Command, path: &str, found: &mut BTreeSet<String>) {
        if command.get_arguments().any(|argument| argument.get_long() == Some("json")) {
            found.insert(path.trim().to_owned());
        }
        for sub in command.get_subcommands() {
            with_json(sub, &format!("{path} {}", sub.get_name()), found);
        }
    }

    #[test]
    fn every_command_with_json_has_a_schema() {
        let mut found = BTreeSet::new();
        with_json(&super::super::Arguments::command(), "", &mut found);
        assert_eq!(found, SCHEMAS.iter().map(|(name, _)| (*name).to_owned()).collect());
    }

    /// Each key is described, so that the schema is its documentation.
    #[test]
    fn every_key_is_described() {
        fn check(schema: &serde_json::Value, path: &str) {
            let properties = schema["properties"].as_object().into_iter().flatten();
            properties.for_each(|(key, property)| {
                assert!(property["description"].is_string(), "{path}: {key} has no description");
            });
            match schema {
                serde_json::Value::Object(members) => members.values().for_each(|member| check(member, path)),
                serde_json::Value::Array(members) => members.iter().for_each(|member| check(member, path)),
                _ => {}
            }
        }
        SCHEMAS.iter().for_each(|(name, schema)| check(schema().as_value(), name));
    }
}
