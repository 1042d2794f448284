//! Reading and writing HamNoSys, in signs per second.
//!
//! The signs are generated here: they are as long as real ones (16 symbols on average) and as varied: one and two
//! hands, splits, contacts, replacements, compounds; one in four is spelled differently from the printer's form, so
//! that it is read twice. For comparison, the text is also split into characters with a look-up of each, which is the
//! least that any reader does.

use chereme_sign::hamnosys::{HamnosysSymbol, from_names, parse_hamnosys, print_hamnosys, sign_hamnosys_text};
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

const SIGNS: [&str; 16] = [
    "finger2 extfingeru palml chin touch moveo",
    "flathand thumboutmod extfingero palmd chest lrat moved smallmod repeatfromstart",
    "symmlr fist thumbacrossmod extfingeru palml shoulders moveo smallmod fast halt",
    "symmlr fingerstraightmod largemod finger2345 extfingerol palmul close circlel repeatfromstartseveral",
    "finger23spread thumbacrossmod extfingerul palmdl cheek lrat seqbegin touch fingertip indexfinger seqend twisting",
    "parbegin finger2 extfingerol palmd plus flathand extfingeror palmu parend palm seqbegin touch pinkyside seqend moved smallmod",
    "symmlr flathand parbegin extfingeruo palml plus extfingerr palmr parend parbegin fingerpad plus palm parend touch chest mover",
    "pinchall fingerstraightmod extfingeru palmd forehead close parbegin moveo replace finger2345 thumboutmod parend",
    "flathand between flathand fingerstraightmod extfingeruo extfingerol palmd nose touch parbegin moved arcu replace extfingerl parend chin touch",
    "fist extfingeru palml shoulders parbegin moveo arcu plus nomotion parend repeatfromstart alternatingmotion",
    "symmpar cee12 extfingero palmu stomach between chest circleu largemod clocku clockfull slow",
    "finger2 pinky extfingerdl palmr neck moveul wavy smallmod plus fist extfingero palmd moved halt",
    "symmlr largemod fingerstraightmod fist fingerhookmod thumboutmod extfingeru palml indexfinger fingertip touch movel",
    "finger2 fingerbendmod thumboutmod extfingerul palmd eyes seqbegin close indexfinger fingernail seqend movei fast",
    "flathand extfingero palmd chest moveo seqbegin brushing palm touch seqend repeatreverse",
    "fist thumboutmod extfingerl palmdl shouldertop nodding smallmod repeatfromstart",
];

fn signs() -> Vec<String> {
    SIGNS
        .iter()
        .map(|names| from_names(names.split(' ')).expect("known names"))
        .collect()
}

#[divan::bench]
fn read(bencher: Bencher) {
    let signs = signs();
    bencher
        .counter(ItemsCount::new(signs.len()))
        .bench(|| signs.iter().filter(|text| parse_hamnosys(text).is_ok()).count());
}

#[divan::bench]
fn write(bencher: Bencher) {
    let trees: Vec<_> = signs()
        .iter()
        .map(|text| parse_hamnosys(text).expect("a sign").sign)
        .collect();
    bencher
        .counter(ItemsCount::new(trees.len()))
        .bench(|| trees.iter().map(|sign| sign_hamnosys_text(sign).len()).sum::<usize>());
}

#[divan::bench]
fn write_and_look_for_losses(bencher: Bencher) {
    let trees: Vec<_> = signs()
        .iter()
        .map(|text| parse_hamnosys(text).expect("a sign").sign)
        .collect();
    bencher.counter(ItemsCount::new(trees.len())).bench(|| {
        trees
            .iter()
            .map(|sign| print_hamnosys(sign).losses.len())
            .sum::<usize>()
    });
}

#[divan::bench]
fn look_up_characters_only(bencher: Bencher) {
    let signs = signs();
    let classes = |text: &String| {
        text.chars()
            .filter_map(HamnosysSymbol::from_char)
            .map(|symbol| symbol.symbol_class() as usize)
            .sum::<usize>()
    };
    bencher
        .counter(ItemsCount::new(signs.len()))
        .bench(|| signs.iter().map(classes).sum::<usize>());
}
