//! Calls of stubs become calls of imported functions.
//!
//! A call passes its arguments by value, whatever the front-end makes of parameters: those of glslang's HLSL and of DXC are
//! pointers to variables, which are loaded first. The stubs themselves are left without callers, for the optimiser to
//! remove.

use super::signature::{Signature, Type};
use super::words::{Instruction, Module, Op, instructions, literal, push};
use super::{Error, stubs};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;

const CAPABILITY_LINKAGE: u32 = 5;
const DECORATION_LINKAGE: u32 = 41;
const LINKAGE_IMPORT: u32 = 1;
const STORAGE_FUNCTION: u32 = 7;

/// Source languages that tools of 2023 know are below; theirs is of no use to them.
const SOURCE_LANGUAGES: u32 = 7;

/// The stubs of a module, in the order of their ids: id, signature, and the type of the function, by id.
type Stubs = Vec<(u32, Rc<Signature>, u32)>;

/// A module that imports the functions that its stubs stand for, and their names.
pub fn imports(mut module: Module) -> Result<(Module, Vec<String>), Error> {
    let stubs = find_stubs(&module, stubs::VERSION)?;
    let mut types = Types::of(&module);
    let (mut imports, mut places, mut by_id) = (Vec::new(), HashMap::new(), HashMap::new());
    for (id, signature, of_type) in stubs {
        // A module of several files can have a copy of the stubs of each.
        let place = match places.entry((signature.name.clone(), of_type)) {
            Entry::Occupied(place) => *place.get(),
            Entry::Vacant(place) => {
                let stub = declaration(of_type, &types).filter(|stub| stub.is(&signature, &types));
                let stub = stub.ok_or_else(|| Error::WrongTypes { signature: signature.to_string() })?;
                imports.push(Import::new(&signature, stub, &mut types, &mut module));
                *place.insert(imports.len() - 1)
            }
        };
        by_id.insert(id, place);
    }
    let mut names: Vec<String> =
        imports.iter().map(|import: &Import| import.signature.name.clone()).collect();
    names.sort_unstable();
    names.dedup();
    write(&mut module, &imports, &by_id, types.added);
    Ok((module, names))
}

/// The functions that have the names of stubs, if they are of this version.
fn find_stubs(module: &Module, version: &str) -> Result<Stubs, Error> {
    let functions: HashMap<u32, u32> =
        module.all(Op::Function).filter_map(|function| function.word(1).zip(function.word(3))).collect();
    let known: HashMap<String, Rc<Signature>> =
        Signature::all().map(|signature| (signature.name.clone(), Rc::new(signature))).collect();
    let (mut stubs, mut markers) = (Stubs::new(), Vec::new());
    for name in module.all(Op::Name) {
        let found = name.word(0).and_then(|id| Some((id, *functions.get(&id)?)));
        let Some((id, of_type)) = found else { continue };
        let text = name.text(1);
        // glslang adds the types of parameters: `unitvec_oct16_encode(vf3;`.
        let text = text.split('(').next().unwrap_or_default();
        if text.starts_with(stubs::MARKER) {
            markers.push(text.to_owned());
        } else if let Some(signature) = known.get(text) {
            stubs.push((id, signature.clone(), of_type));
        }
    }
    stubs.sort_by_key(|(id, ..)| *id);
    let own = stubs::marker(version);
    match markers.iter().find(|marker| **marker != own) {
        Some(marker) => {
            // `_` stood for some character of the version, most likely a dot.
            let found = marker.trim_start_matches(stubs::MARKER).replace('_', ".");
            return Err(Error::OtherVersion { found: unitvec_files::one_line(found) });
        }
        None if stubs.is_empty() => return Err(Error::NoStubs),
        None if markers.is_empty() => return Err(Error::NoVersion),
        None => {}
    }
    Ok(stubs)
}

/// A function's result type and parameter types, by id.
struct Declaration {
    result: u32,
    parameters: Vec<u32>,
}

impl Declaration {
    fn is(&self, signature: &Signature, types: &Types) -> bool {
        let is_one = |(id, (_, of_type)): (&u32, &(&str, Type))| types.is(types.pointee(*id), *of_type);
        types.is(self.result, signature.result)
            && self.parameters.len() == signature.parameters.len()
            && self.parameters.iter().zip(&signature.parameters).all(is_one)
    }
}

fn declaration(of_type: u32, types: &Types) -> Option<Declaration> {
    match types.known.get(&of_type)? {
        Known::Function(result, parameters) => {
            Some(Declaration { result: *result, parameters: parameters.clone() })
        }
        _ => None,
    }
}

/// The known facts about a type.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Known {
    Float,
    Uint,
    Vector(u32, u32),
    Struct(Vec<u32>),
    /// A pointer to a function's variable.
    Pointer(u32),
    Function(u32, Vec<u32>),
}

/// A module's types, and those that it gets.
struct Types {
    known: HashMap<u32, Known>,
    /// The ids of the types of functions.
    of_functions: HashMap<Known, u32>,
    /// Instructions.
    added: Vec<u32>,
    /// The struct of frames, as the library has it.
    frame: Option<u32>,
}

impl Types {
    fn of(module: &Module) -> Self {
        let known = module.instructions().filter_map(|instruction| {
            let [id, rest @ ..] = instruction.operands else { return None };
            let known = match (instruction.op()?, rest) {
                (Op::TypeFloat, [32]) => Known::Float,
                (Op::TypeInt, [32, 0]) => Known::Uint,
                (Op::TypeVector, [component, count]) => Known::Vector(*component, *count),
                (Op::TypeStruct, members) => Known::Struct(members.to_vec()),
                (Op::TypePointer, [STORAGE_FUNCTION, to]) => Known::Pointer(*to),
                (Op::TypeFunction, [result, parameters @ ..]) => {
                    Known::Function(*result, parameters.to_vec())
                }
                _ => return None,
            };
            Some((*id, known))
        });
        let known: HashMap<u32, Known> = known.collect();
        let of_functions = known.iter().filter(|(_, known)| matches!(known, Known::Function(..)));
        let of_functions = of_functions.map(|(id, known)| (known.clone(), *id)).collect();
        Self { known, of_functions, added: Vec::new(), frame: None }
    }

    fn is(&self, id: u32, of_type: Type) -> bool {
        let vector = |scalar: Known, n: u32| {
            matches!(self.known.get(&id), Some(Known::Vector(component, count))
                if *count == n && self.known.get(component) == Some(&scalar))
        };
        match of_type {
            Type::Uint => self.known.get(&id) == Some(&Known::Uint),
            Type::Uvec2 => vector(Known::Uint, 2),
            Type::Vec3 => vector(Known::Float, 3),
            Type::Vec4 => vector(Known::Float, 4),
            Type::Frame => matches!(self.known.get(&id), Some(Known::Struct(members))
                if matches!(members[..], [normal, tangent]
                    if self.is(normal, Type::Vec3) && self.is(tangent, Type::Vec4))),
        }
    }

    /// The type that a pointer points to; other types themselves.
    fn pointee(&self, id: u32) -> u32 {
        match self.known.get(&id) {
            Some(Known::Pointer(to)) => *to,
            _ => id,
        }
    }

    /// The struct of frames without decorations, such as a front-end's may have.
    fn frame(&mut self, members: [u32; 2], module: &mut Module) -> u32 {
        *self.frame.get_or_insert_with(|| {
            let id = module.fresh();
            push(&mut self.added, Op::TypeStruct as u32, &[id, members[0], members[1]]);
            id
        })
    }

    /// The type of functions with these types: there may be only one.
    fn function(&mut self, result: u32, parameters: &[u32], module: &mut Module) -> u32 {
        let wanted = Known::Function(result, parameters.to_vec());
        if let Some(id) = self.of_functions.get(&wanted) {
            return *id;
        }
        let id = module.fresh();
        let operands: Vec<u32> = [id, result].iter().chain(parameters).copied().collect();
        push(&mut self.added, Op::TypeFunction as u32, &operands);
        self.of_functions.insert(wanted, id);
        id
    }
}

/// A function of the library, as a module declares it.
struct Import {
    signature: Rc<Signature>,
    id: u32,
    of_type: u32,
    result: u32,
    parameters: Vec<u32>,
    /// The parameters that the stub takes by pointer.
    by_pointer: Vec<bool>,
    /// Types of the members of a result that is a struct.
    members: Option<[u32; 2]>,
}

impl Import {
    fn new(signature: &Rc<Signature>, stub: Declaration, types: &mut Types, module: &mut Module) -> Self {
        let parameters: Vec<u32> = stub.parameters.iter().map(|id| types.pointee(*id)).collect();
        let by_pointer = stub.parameters.iter().zip(&parameters).map(|(id, to)| id != to).collect();
        let members = match types.known.get(&stub.result) {
            Some(Known::Struct(members)) => members.as_slice().try_into().ok(),
            _ => None,
        };
        let result = members.map_or(stub.result, |members| types.frame(members, module));
        let of_type = types.function(result, &parameters, module);
        Self {
            signature: signature.clone(),
            id: module.fresh(),
            of_type,
            result,
            parameters,
            by_pointer,
            members,
        }
    }

    /// Writes a function without a body.
    fn declare(&self, words: &mut Vec<u32>, module: &mut Module) {
        push(words, Op::Function as u32, &[self.result, self.id, 0, self.of_type]);
        for of_type in &self.parameters {
            push(words, Op::FunctionParameter as u32, &[*of_type, module.fresh()]);
        }
        push(words, Op::FunctionEnd as u32, &[]);
    }

    fn decorate(&self, words: &mut Vec<u32>) {
        let mut operands = vec![self.id, DECORATION_LINKAGE];
        operands.extend(literal(&self.signature.name));
        operands.push(LINKAGE_IMPORT);
        push(words, Op::Decorate as u32, &operands);
    }

    /// Writes the instructions in place of a call of the stub, with this result type, result and arguments.
    fn call(&self, of_type: u32, result: u32, arguments: &[u32], words: &mut Vec<u32>, module: &mut Module) {
        let mut operands = vec![self.result, result, self.id];
        for ((argument, is_pointer), of_type) in arguments.iter().zip(&self.by_pointer).zip(&self.parameters)
        {
            let mut value = *argument;
            if *is_pointer {
                value = module.fresh();
                push(words, Op::Load as u32, &[*of_type, value, *argument]);
            }
            operands.push(value);
        }
        let Some(members) = self.members else {
            return push(words, Op::FunctionCall as u32, &operands);
        };
        let frame = module.fresh();
        operands[1] = frame;
        push(words, Op::FunctionCall as u32, &operands);
        let mut constructed = vec![of_type, result];
        for (n, member) in (0..).zip(members) {
            let part = module.fresh();
            push(words, Op::CompositeExtract as u32, &[member, part, frame, n]);
            constructed.push(part);
        }
        push(words, Op::CompositeConstruct as u32, &constructed);
    }
}

/// Writes capability, decorations, types, declarations and calls, each where SPIR-V wants it.
fn write(module: &mut Module, imports: &[Import], by_id: &HashMap<u32, usize>, types: Vec<u32>) {
    let mut sorted: Vec<&Import> = imports.iter().collect();
    sorted.sort_unstable_by(|a, b| a.signature.name.cmp(&b.signature.name).then(a.id.cmp(&b.id)));
    let (mut decorations, mut declarations) = (Vec::new(), types);
    for import in sorted {
        import.decorate(&mut decorations);
        import.declare(&mut declarations, module);
    }
    // Calls become longer; where they are most of the module, the list grows.
    let added = module.words.len() / 8 + decorations.len() + declarations.len();
    let mut words = Vec::with_capacity(module.words.len() + added);
    if !module.all(Op::Capability).any(|instruction| instruction.operands == [CAPABILITY_LINKAGE]) {
        push(&mut words, Op::Capability as u32, &[CAPABILITY_LINKAGE]);
    }
    for Instruction { opcode, operands } in instructions(&std::mem::take(&mut module.words)) {
        if is_after_names(opcode) {
            words.append(&mut decorations);
        }
        match (Op::from_u32(opcode), operands) {
            (Some(Op::Function), _) => words.append(&mut declarations),
            (Some(Op::FunctionCall), [of_type, result, callee, arguments @ ..]) => {
                if let Some(place) = by_id.get(callee) {
                    imports[*place].call(*of_type, *result, arguments, &mut words, module);
                    continue;
                }
            }
            (Some(Op::Source), [language, rest @ ..]) if *language >= SOURCE_LANGUAGES => {
                push(&mut words, opcode, &[&[0], rest].concat());
                continue;
            }
            _ => {}
        }
        push(&mut words, opcode, operands);
    }
    module.words = words;
}

/// True for decorations and for the types after them.
fn is_after_names(opcode: u32) -> bool {
    let is_from = |first: Op, last: Op| (first as u32..=last as u32).contains(&opcode);
    let others = [Op::DecorateId, Op::DecorateString, Op::MemberDecorateString, Op::Function];
    is_from(Op::Decorate, Op::GroupMemberDecorate)
        || is_from(Op::TypeVoid, Op::TypeForwardPointer)
        || others.iter().any(|op| *op as u32 == opcode)
}

#[cfg(test)]
mod tests {
    use super::super::words::literal;
    use super::*;

    /// A module that has functions of these names, and nothing else.
    fn with_functions(names: &[&str]) -> Module {
        let header = [0x0723_0203, 0x0001_0300, 0, 99, 0_u32];
        let bytes: Vec<u8> = header.into_iter().flat_map(u32::to_le_bytes).collect();
        let mut module = Module::parse(&bytes).unwrap();
        for (id, name) in (1..).zip(names) {
            push(&mut module.words, Op::Name as u32, &[&[id][..], &literal(name)].concat());
            push(&mut module.words, Op::Function as u32, &[90, id, 0, 91]);
        }
        module
    }

    /// Versions can have signs that names cannot.
    #[test]
    fn stubs_of_the_same_version_are_found() {
        let stub = "unitvec_oct16_encode(vf3;";
        let module = with_functions(&[stub, "unitvec_stubs_0_2_0_rc_1(f1;"]);
        assert_eq!(find_stubs(&module, "0.2.0-rc.1").unwrap().len(), 1);
        for version in ["0.2.0", "0.2.0-rc.2"] {
            let error = find_stubs(&module, version).unwrap_err();
            assert!(matches!(&error, Error::OtherVersion { found } if found == "0.2.0.rc.1"), "{error}");
        }
        assert!(matches!(find_stubs(&with_functions(&[stub]), "0.2.0"), Err(Error::NoVersion)));
    }
}
