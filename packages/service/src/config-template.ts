/** Writes a commented configuration file from a program's own options, so it always matches what the program reads. */
import { stringify } from 'yaml';
import { type OptionPlace, type OptionTable, optionPlaces, type ProgramDefinition } from './option-table.ts';

export interface ConfigTemplate {
  /** Comment at the top; one line per entry. */
  readonly head: readonly string[];
  /** Active values by option; the other options are written behind a `#`, with their defaults. */
  readonly values: Readonly<Record<string, unknown>>;
  /** Options that are not shown. */
  readonly leftOut?: readonly string[];
}

/** Maximum width of a comment, columns. */
const WIDTH = 110;

/** @returns YAML that the program accepts as it is, and also with every `#key:` line active */
export function configTemplate<Table extends OptionTable>(
  definition: ProgramDefinition<Table>,
  { head, values, leftOut = [] }: ConfigTemplate,
): string {
  const lines = [...head.map((line) => `# ${line}`.trimEnd()), `${definition.section}:`];
  for (const [group, places] of byGroup(optionPlaces(definition), leftOut)) {
    if (group !== '') lines.push('', `  ${group}:`);
    const indent = group === '' ? '  ' : '    ';
    for (const { key, spec, file } of places) {
      lines.push(...comment(spec.help, indent));
      const name = group === '' ? file : file.slice(group.length + 1);
      const given = Object.hasOwn(values, key);
      const value = given ? values[key] : spec.default;
      lines.push(...entry(name, value, given ? indent : `${indent}#`, spec.argument));
    }
  }
  return `${lines.join('\n')}\n`;
}

type FilePlace = OptionPlace & { file: string };

/** In the order of the table; options without a group first. */
function byGroup(places: readonly OptionPlace[], leftOut: readonly string[]): Map<string, FilePlace[]> {
  const groups = new Map<string, FilePlace[]>([['', []]]);
  for (const place of places) {
    if (place.file === null || leftOut.includes(place.key)) continue;
    const group = place.file.includes('.') ? place.file.slice(0, place.file.indexOf('.')) : '';
    const list = groups.get(group) ?? [];
    list.push(place as FilePlace);
    groups.set(group, list);
  }
  return groups;
}

function entry(name: string, value: unknown, indent: string, argument: string | undefined): string[] {
  // Nothing after the colon is YAML's null, which counts as absent.
  if (value === null) return [`${indent}${name}:${argument === undefined ? '' : ` # ${argument}`}`];
  // A list behind a `#` stays on one line, so that removing the `#` is enough.
  const oneLine = !Array.isArray(value) || value.length === 0 || indent.endsWith('#');
  if (oneLine) return [`${indent}${name}: ${flow(value)}`];
  return [`${indent}${name}:`, ...value.map((item) => `${indent}  - ${flow(item)}`)];
}

function flow(value: unknown): string {
  return stringify(value, { collectionStyle: 'flow', lineWidth: 0 }).trim();
}

function comment(text: string, indent: string): string[] {
  const lines: string[] = [];
  let line = `${indent}#`;
  for (const word of text.split(' ')) {
    if (line.length + word.length >= WIDTH) {
      lines.push(line);
      line = `${indent}#`;
    }
    line += ` ${word}`;
  }
  return [...lines, line];
}
