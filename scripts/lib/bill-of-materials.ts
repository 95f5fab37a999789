/** Adds the Rust crates to the bill of materials that pnpm writes (CycloneDX 1.6). */
import * as z from 'zod';
import { crateNamed, type LockedCrate } from './cargo-lock.ts';

const dependencySchema = z.looseObject({ ref: z.string(), dependsOn: z.optional(z.array(z.string())) });
const componentSchema = z.looseObject({
  type: z.string(),
  name: z.string(),
  version: z.string(),
  purl: z.string(),
  'bom-ref': z.string(),
});

const billSchema = z.looseObject({
  bomFormat: z.literal('CycloneDX'),
  specVersion: z.literal('1.6'),
  metadata: z.looseObject({ component: componentSchema }),
  components: z.array(componentSchema),
  dependencies: z.array(dependencySchema),
});

export type BillOfMaterials = z.output<typeof billSchema>;

/** @throws {Error} if it is not CycloneDX 1.6 with what is needed here */
export function readBill(text: string): BillOfMaterials {
  return billSchema.parse(JSON.parse(text));
}

/** @returns the bill with every crate of the lock file, on which the project depends through its own crates */
export function withCrates(bill: BillOfMaterials, crates: readonly LockedCrate[]): BillOfMaterials {
  const own = crates.filter(({ source }) => source === null).map(crateUrl);
  const project = bill.metadata.component['bom-ref'];
  const roots = bill.dependencies.find(({ ref }) => ref === project)?.dependsOn ?? [];
  return {
    ...bill,
    components: [...bill.components, ...crates.map(toComponent)],
    dependencies: [
      ...bill.dependencies.filter(({ ref }) => ref !== project),
      { ref: project, dependsOn: [...roots, ...own] },
      ...crates.map((crate) => ({
        ref: crateUrl(crate),
        dependsOn: crate.dependencies.map((name) => crateUrl(crateNamed(crates, name))),
      })),
    ],
  };
}

function toComponent(crate: LockedCrate): BillOfMaterials['components'][number] {
  const { name, version, checksum } = crate;
  const purl = crateUrl(crate);
  return {
    type: 'library',
    name,
    version,
    purl,
    'bom-ref': purl,
    ...(checksum === null ? {} : { hashes: [{ alg: 'SHA-256', content: checksum }] }),
  };
}

/** The package URL (purl) of a crate. */
function crateUrl({ name, version }: LockedCrate): string {
  return `pkg:cargo/${name}@${version}`;
}
