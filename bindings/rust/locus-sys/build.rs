//! Finds liblocus, and liblocus_cold for the feature `cold`: in the folder LOCUS_LIB_DIR, else where pkg-config says, else where the linker looks.
use std::env;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=LOCUS_LIB_DIR");
    println!("cargo:rerun-if-env-changed=PKG_CONFIG_PATH");
    if env::var_os("CARGO_FEATURE_COLD").is_some() {
        println!("cargo:rustc-link-lib=dylib=locus_cold");
    }
    println!("cargo:rustc-link-lib=dylib=locus");
    if let Ok(folder) = env::var("LOCUS_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
        return;
    }
    let pkg_config = env::var("PKG_CONFIG").unwrap_or_else(|_| "pkg-config".into());
    match Command::new(pkg_config).args(["--libs-only-L", "locus"]).output() {
        Ok(output) if output.status.success() => {
            for flag in String::from_utf8_lossy(&output.stdout).split_whitespace() {
                if let Some(folder) = flag.strip_prefix("-L") {
                    println!("cargo:rustc-link-search=native={folder}");
                }
            }
        }
        _ => println!("cargo:warning=neither LOCUS_LIB_DIR nor pkg-config says where liblocus is"),
    }
}
