/** JSON Schema (draft 7) of the configuration file, from the programs' own options: editors complete and check by it. */
import { type OptionPlace, type OptionTable, optionPlaces, type ProgramDefinition } from './option-table.ts';
import { type JsonSchema, valueSchema } from './value-schema.ts';

/** @param programs whose sections it describes; sections of others may have any content */
export function configSchema(programs: readonly ProgramDefinition<OptionTable>[]): JsonSchema {
  const sections = programs.map((program) => [program.section, sectionSchema(program)]);
  return {
    $schema: 'http://json-schema.org/draft-07/schema#',
    title: 'Configuration of Farpoint (farpoint.yaml)',
    type: ['object', 'null'],
    properties: Object.fromEntries(sections),
  };
}

interface Group {
  /** All of its keys may be commented out. */
  type: readonly ['object', 'null'];
  description?: string;
  additionalProperties: false;
  properties: Record<string, JsonSchema | Group>;
}

const emptyGroup = (): Group => ({ type: ['object', 'null'], additionalProperties: false, properties: {} });

function sectionSchema(program: ProgramDefinition<OptionTable>): Group {
  const section = { ...emptyGroup(), description: program.summary };
  for (const place of optionPlaces(program)) {
    if (place.file === null) continue;
    const path = place.file.split('.');
    const name = path.pop() as string;
    let group: Group = section;
    for (const part of path) {
      group.properties[part] ??= emptyGroup();
      group = group.properties[part] as Group;
    }
    group.properties[name] = optionSchema(place);
  }
  return section;
}

/** A key without a value counts as absent. */
function optionSchema({ spec }: OptionPlace): JsonSchema {
  // JSON knows no infinity.
  const isShown = spec.default !== null && !spec.secret && spec.default !== Number.POSITIVE_INFINITY;
  return {
    description: spec.help,
    ...(isShown ? { default: spec.default } : {}),
    anyOf: [{ type: 'null' }, valueSchema(spec.schema)],
  };
}
