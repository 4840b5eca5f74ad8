use super::table::{self, Layout, left, right};
use super::{chosen_formats, print};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, CODECS, Operation};
use unitvec_host::{Error, Result};
use unitvec_run::shader;
use unitvec_run::shader::{EXACT, Edition, Language, library, text};

#[derive(Args)]
pub struct Arguments {
    /// Language to write; --list says what each is. unity, unreal, webgpu, metal, webgl, cuda, hip and bevy stand for the
    /// language of their shaders.
    #[arg(long, value_name = "LANGUAGE", required_unless_present = "list", value_parser = languages())]
    language: Option<Language>,
    /// Codec to write, both halves of it, as `unitvec codecs` lists them; may be given again. All of them without this and
    /// --function.
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    codec: Vec<String>,
    /// Function to write, as --list names them; may be given again, also beside --codec. Half of a codec is a function:
    /// oct32_decode.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = function)]
    function: Vec<String>,
    /// The exact edition: quotients and roots are put right, and compilers cannot fuse and reorder operations, so that results
    /// are the CPU's. In HLSL the macro UNITVEC_EXACT, defined before the text, makes it exact.
    #[arg(long)]
    exact: bool,
    /// Write a folder, which -o names, with all codecs in a file each family, and the exact edition below it in exact/.
    #[arg(long, requires = "output", conflicts_with_all = ["codec", "function", "exact"])]
    all: bool,
    /// File to write; - for the standard output, which it is if not given. With --all the folder, which is made.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// List the languages and all functions, and write nothing.
    #[arg(long, conflicts_with_all = ["language", "codec", "function", "exact", "all", "output"])]
    list: bool,
    #[command(flatten)]
    wide: table::Wide,
}

fn languages() -> impl TypedValueParser<Value = Language> {
    let names = |language: Language| PossibleValue::new(language.id()).aliases(users(language));
    let is_named =
        |language: &Language, name: &str| language.id() == name || users(*language).contains(&name);
    PossibleValuesParser::new(Language::ALL.map(names))
        .try_map(move |name| Language::ALL.into_iter().find(|one| is_named(one, &name)).ok_or("no language"))
}

/// Names of what a language is written for.
const fn users(language: Language) -> &'static [&'static str] {
    match language {
        Language::Hlsl => &["unity", "unreal"],
        Language::Wgsl => &["webgpu"],
        Language::Msl => &["metal"],
        Language::GlslEs => &["webgl"],
        Language::Cpp => &["cuda", "hip"],
        Language::NagaOil => &["bevy"],
        Language::Glsl | Language::Slang | Language::Godot | Language::Wesl => &[],
    }
}

/// No function has this name.
#[derive(Clone, Debug, thiserror::Error)]
#[error("unknown function; similar: {}; `unitvec shader --list` names all", .0.join(", "))]
struct UnknownFunction(Vec<&'static str>);

/// All functions for users; none where the library cannot be parsed, which tests rule out.
fn functions() -> impl Iterator<Item = &'static str> {
    library().into_iter().flat_map(|library| library.functions())
}

fn function(name: &str) -> Result<String, UnknownFunction> {
    let mut similar: Vec<&'static str> = functions().collect();
    similar.sort_by_key(|other| (!other.starts_with(name), strsim::damerau_levenshtein(other, name)));
    similar.truncate(3);
    if similar.contains(&name) { Ok(name.to_owned()) } else { Err(UnknownFunction(similar)) }
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let language = match (arguments.list, arguments.language) {
        (false, Some(language)) => language,
        _ => return print(&list(arguments.wide.columns()?)),
    };
    if let (true, Some(folder)) = (arguments.all, arguments.output.as_deref()) {
        return write_all(language, folder);
    }
    let edition = if arguments.exact { Edition::Exact } else { Edition::Plain };
    if !language.editions().contains(&edition) {
        return Err(Error::Usage(format!(
            "{language} has no exact edition of its own: the macro {EXACT}, defined before the text, makes it exact; leave --exact out"
        )));
    }
    let mut functions = arguments.function.clone();
    if functions.is_empty() || !arguments.codec.is_empty() {
        let formats = chosen_formats(&arguments.codec)?;
        functions.extend(formats.iter().flat_map(|format| Operation::ALL.map(|half| format.function(half))));
    }
    let text = text(&functions, language, edition, &command(arguments, language))?;
    match arguments.output.as_deref() {
        Some(path) if path != Path::new("-") => {
            unitvec_files::write_file(path, text.as_bytes())?;
            Ok(ExitCode::SUCCESS)
        }
        _ => print(&text),
    }
}

fn write_all(language: Language, folder: &Path) -> Result<ExitCode> {
    if folder == Path::new("-") {
        return Err(Error::Usage("--all writes many files: -o has to name a folder for them".to_owned()));
    }
    let files = library().and_then(|library| library.folder(language)).map_err(shader::Error::from)?;
    for (name, text) in &files {
        let path = folder.join(name);
        let below = path.parent().unwrap_or(folder);
        fs::create_dir_all(below).map_err(|source| unitvec_files::Error::writing(below, source))?;
        unitvec_files::write_file(&path, text.as_bytes())?;
    }
    print(&format!("shader: {} files of {language} in {}\n", files.len(), folder.display()))
}

/// What wrote a text, for its head.
fn command(arguments: &Arguments, language: Language) -> String {
    let exact = if arguments.exact { " --exact" } else { "" };
    let mut command = format!("unitvec shader --language {}{exact}", language.id());
    for (option, names) in [("codec", &arguments.codec), ("function", &arguments.function)] {
        command.extend(names.iter().map(|name| format!(" --{option} {name}")));
    }
    command
}

fn list(columns: Option<usize>) -> String {
    let languages = Layout::new(
        vec![left("language", 10), left("name", 26), left("files", 12), left("editions", 12)],
        columns,
    );
    let mut text = languages.heading();
    for language in Language::ALL {
        let editions = if language.editions().len() > 1 { "plain, exact" } else { "plain" };
        text += &languages.line(&[&language.id(), &language.name(), &language.extension(), &editions]);
    }
    let codecs =
        Layout::new(vec![left("codec", 20), right("bits", 4), left("functions", 55).apart()], columns);
    text.push('\n');
    text += &codecs.heading();
    for format in &CODECS {
        let AnyCodec { id, bits, .. } = format;
        let functions = Operation::ALL.map(|operation| format.function(operation)).join(", ");
        text += &codecs.line(&[&id, &bits, &functions]);
    }
    let of_codecs: HashSet<String> =
        CODECS.iter().flat_map(|format| Operation::ALL.map(|operation| format.function(operation))).collect();
    let mut others: Vec<&str> = functions().filter(|name| !of_codecs.contains(*name)).collect();
    const WRAPPERS: &[&str] = &["axial", "angle", "vector32", "vector48", "length", "reach", "cap", "dense"];
    let groups: [(&str, &[&str]); 5] = [
        ("wrappers", WRAPPERS),
        ("projections", &["float32x3"]),
        ("formats", &["_to_"]),
        ("nulls", &["_or_"]),
        ("dither", &[""]),
    ];
    for (group, parts) in groups {
        let is_of_group = |name: &mut &str| parts.iter().any(|part| name.contains(part));
        let names: Vec<&str> = others.extract_if(.., is_of_group).collect();
        text += &format!("\n{group}\n{}\n", table::wrapped(&names.join(", "), "", columns.or(Some(120))));
    }
    text + &table::left_out(&[&languages, &codecs])
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    /// The help names all that stand for a language, and each is taken.
    #[test]
    fn users_stand_for_languages() {
        let help = <Line as clap::CommandFactory>::command().render_long_help().to_string();
        for (language, name) in
            Language::ALL.iter().flat_map(|one| users(*one).iter().map(move |name| (one, name)))
        {
            assert!(
                help.contains(&format!("{name},")) || help.contains(&format!("{name} ")),
                "{name}: {help}"
            );
            let line =
                Line::try_parse_from(["shader", "--language", name]).map(|line| line.arguments.language);
            assert_eq!(line.ok().flatten(), Some(*language), "{name}");
        }
    }
}
