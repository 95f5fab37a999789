/** Describes a program's configuration file to editors: JSON Schema (draft 2020-12), from the same table as everything else. */
import * as z from 'zod';
import {
  type ConfigSection,
  configSections,
  type OptionTable,
  optionPlaces,
  type ProgramDefinition,
} from './option-table.ts';

/** A part of a schema. */
type Node = Record<string, unknown>;
/** A mapping of the file, whose keys are all known. */
interface Mapping extends Node {
  properties: Record<string, Node>;
}

/** @returns the schema of a file for this program; sections of other programs may hold anything */
export function configSchema<Table extends OptionTable>(definition: ProgramDefinition<Table>): Node {
  const section = mapping();
  for (const { spec, file } of optionPlaces(definition)) {
    if (file === null) continue;
    const keys = file.split('.');
    const name = keys.pop() as string;
    const parent = keys.reduce((at, key) => {
      at.properties[key] ??= mapping();
      return at.properties[key] as Mapping;
    }, section);
    parent.properties[name] = {
      ...orNothing(valueSchema(spec.schema)),
      description: spec.help,
      // `null` and what a file cannot hold say nothing to an editor.
      ...(isPlain(spec.default) ? { default: spec.default } : {}),
    };
  }
  const others = configSections.filter((each): each is ConfigSection => each !== definition.section);
  return {
    $schema: 'https://json-schema.org/draft/2020-12/schema',
    title: `Configuration of ${definition.name}`,
    ...mapping(),
    properties: { ...Object.fromEntries(others.map((each) => [each, {}])), [definition.section]: section },
  };
}

/** Nothing after a colon is YAML's null, which counts as absent. */
function mapping(): Mapping {
  return { type: ['object', 'null'], additionalProperties: false, properties: {} };
}

/** What a file may hold. Text that a program reads in a way of its own is described by its option's help alone. */
function valueSchema(schema: z.core.$ZodType): Node {
  const options = { unrepresentable: 'any', cycles: 'ref', target: 'draft-2020-12' } as const;
  const { $schema: _, ...output } = z.toJSONSchema(schema, { ...options, io: 'output' }) as Node;
  if (Object.keys(output).length > 0) return output;
  const { $schema: __, ...input } = z.toJSONSchema(schema, { ...options, io: 'input' }) as Node;
  return input;
}

function orNothing(schema: Node): Node {
  if (Object.keys(schema).length === 0) return schema;
  return { anyOf: [schema, { type: 'null' }] };
}

function isPlain(value: unknown): boolean {
  return value !== null && (typeof value !== 'object' || Array.isArray(value));
}
