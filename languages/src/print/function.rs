//! Functions: their heads, and what comes before their statements.

use super::{Printer, is_public, joined};
use crate::Language;
use crate::syntax::{Branch, Condition, File, Function, Parameter, Type};

impl Printer<'_> {
    pub(super) fn function(&mut self, function: &Function, file: &File) {
        let is_wgsl = self.language == Language::Wgsl;
        self.assigned.clone_from(&function.assigned);
        let outs = function.parameters.iter().filter(|parameter| parameter.is_out && is_wgsl);
        self.pointers = outs.map(|parameter| parameter.name.clone()).collect();
        let head = self.function_head(function, file);
        let copies: Vec<String> = function
            .parameters
            .iter()
            .filter(|parameter| self.is_copied(parameter))
            .map(|Parameter { name, .. }| format!("    var {name} = {name}_in;"))
            .chain(self.unused_in_plain(function))
            .collect();
        self.block(0, &head, &function.body, copies);
        self.pointers.clear();
    }

    /// True for a parameter that a function assigns to, where the language forbids this.
    fn is_copied(&self, parameter: &Parameter) -> bool {
        self.language == Language::Wgsl && !parameter.is_out && self.assigned.contains(&parameter.name)
    }

    /// Uses of the parameters that only the exact edition uses, where compilers warn of the others.
    fn unused_in_plain(&self, function: &Function) -> Vec<String> {
        let used = |exact: Branch| {
            function.names_used(&|condition| match condition {
                Condition::Exact(_) => exact,
                _ => Branch::Both,
            })
        };
        let (all, plain) = (used(Branch::Both), used(Branch::Otherwise));
        let names = function.parameters.iter().map(|parameter| parameter.name.as_str());
        let unused = names
            .filter(|name| self.language == Language::Cpp && all.contains(name) && !plain.contains(name));
        unused.map(|name| format!("    (void){name};")).collect()
    }

    fn function_head(&self, function: &Function, file: &File) -> String {
        let used = function.names_used(&|condition| self.language.branch(self.edition, condition));
        let parameter = |parameter| self.parameter(parameter, &used);
        let parameters = joined(function.parameters.iter().map(parameter));
        let name = &function.name;
        let returns = self.type_name(&function.returns);
        match self.language {
            Language::Wgsl if function.returns == Type::Void => format!("fn {name}({parameters})"),
            Language::Wgsl => format!("fn {name}({parameters}) -> {returns}"),
            Language::Cpp => format!("UNITVEC_FN {returns} {name}({parameters})"),
            Language::Msl => format!("inline {returns} {name}({parameters})"),
            Language::Slang if self.has_module && is_public(name, file) => {
                format!("public {returns} {name}({parameters})")
            }
            _ => format!("{returns} {name}({parameters})"),
        }
    }

    /// `used` are the names that the body uses: compilers of MSL and C++ warn of a parameter with a name and without a use.
    fn parameter(&self, parameter: &Parameter, used: &[&str]) -> String {
        let Parameter { ty, name, is_out } = parameter;
        let ty = self.type_name(ty);
        match (self.language, is_out) {
            (Language::Wgsl, true) => format!("{name}: ptr<function, {ty}>"),
            (Language::Wgsl, false) if self.is_copied(parameter) => format!("{name}_in: {ty}"),
            (Language::Wgsl, false) => format!("{name}: {ty}"),
            (Language::Msl, true) => format!("thread {ty}& {name}"),
            (Language::Cpp, true) => format!("{ty}& {name}"),
            (Language::Msl | Language::Cpp, false) if !used.contains(&name.as_str()) => ty,
            (_, true) => format!("out {ty} {name}"),
            (_, false) => format!("{ty} {name}"),
        }
    }
}
