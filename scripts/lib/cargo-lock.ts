/** Reads Cargo.lock: the part of TOML that Cargo writes. */

export interface LockedCrate {
  readonly name: string;
  readonly version: string;
  /** Null for a crate of this workspace. */
  readonly source: string | null;
  /** SHA-256 of the package; null for a crate of this workspace. */
  readonly checksum: string | null;
  /** `name`, `name version` or `name version (source)`, as far as it takes to tell which. */
  readonly dependencies: readonly string[];
}

/** @throws {Error} with the line that is not as Cargo writes it */
export function readCargoLock(text: string): LockedCrate[] {
  const crates: LockedCrate[] = [];
  for (const [number, block] of text.split(/^\[\[package\]\]$/m).entries()) {
    if (number === 0) continue;
    const fields = new Map<string, string>();
    const dependencies: string[] = [];
    for (const line of block.split('\n')) {
      const [, key, value] = /^(\w+) = "([^"\\]*)"$/.exec(line) ?? [];
      const [, dependency] = /^ "([^"\\]*)",$/.exec(line) ?? [];
      if (key !== undefined && value !== undefined) fields.set(key, value);
      else if (dependency !== undefined) dependencies.push(dependency);
      else if (!/^(dependencies = \[|\]|)$/.test(line))
        throw new Error(`Cargo.lock: not understood: ${line}`);
    }
    const { name, version } = { name: fields.get('name'), version: fields.get('version') };
    if (name === undefined || version === undefined)
      throw new Error(`Cargo.lock: package ${number} has no name or no version`);
    const [source, checksum] = [fields.get('source') ?? null, fields.get('checksum') ?? null];
    crates.push({ name, version, source, checksum, dependencies });
  }
  return crates;
}

/** The crate that a dependency names. @throws {Error} if there is none, or more than one */
export function crateNamed(crates: readonly LockedCrate[], dependency: string): LockedCrate {
  const [name, version] = dependency.split(' ');
  const found = crates.filter((crate) => crate.name === name && (version ?? crate.version) === crate.version);
  const [crate] = found;
  if (crate === undefined || found.length > 1)
    throw new Error(`Cargo.lock: ${found.length} crates are called ${dependency}`);
  return crate;
}
