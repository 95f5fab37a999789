import { type OptionPlace, type OptionTable, optionPlaces, type ProgramDefinition } from './option-table.ts';
import { type PortHolder, portHolder } from './port-holder.ts';
import { fileFault, type ListenFault, listenFault } from './system-error.ts';

/** Why a program cannot start, and what to do about it: printed in one line, without a stack. Exit code 1. */
export class StartFailure extends Error {
  override readonly name = 'StartFailure';
  readonly remedy: string;

  constructor(detail: string, remedy: string, options: { cause?: unknown } = {}) {
    super(detail, options);
    this.remedy = remedy;
  }
}

type Values = Readonly<Record<string, unknown>>;

/**
 * Classifies an exception thrown during the start as a fault of the machine or of a file, if it is one: a port that is
 * in use, an address that is not this machine's, a missing file.
 *
 * @returns `null` if it is a fault of the program itself
 */
export function startFailureOf<Table extends OptionTable>(
  error: unknown,
  definition: ProgramDefinition<Table>,
  values: Values,
  holderOf: (port: number) => PortHolder | null = portHolder,
): StartFailure | null {
  if (error instanceof StartFailure) return error;
  const places = optionPlaces(definition);
  const listen = listenFault(error);
  if (listen !== null) {
    const { detail, remedy } = listenWords(listen, places, values, holderOf);
    return new StartFailure(detail, remedy, { cause: error });
  }
  const file = fileFault(error);
  if (file === null) return null;
  const named = flagsOf(places, (place) => {
    const value = values[place.key];
    return typeof value === 'string' && value !== '' && file.startsWith(`${value} `);
  });
  return new StartFailure(
    file,
    named === '' ? 'check that it exists and that this user may use it' : `set ${named} to another path`,
    { cause: error },
  );
}

function listenWords(
  { code, host, port }: ListenFault,
  places: readonly OptionPlace[],
  values: Values,
  holderOf: (port: number) => PortHolder | null,
): { detail: string; remedy: string } {
  const place = `${host.includes(':') ? `[${host}]` : host}:${port}`;
  const ports = flagsOf(places, ({ key }) => /port$/i.test(key) && values[key] === port);
  const setPort = ports === '' ? 'choose another port' : `set ${ports} to another port`;
  switch (code) {
    case 'EADDRINUSE': {
      const holder = holderOf(port);
      const by = holder === null ? 'another program' : `${holder.program} (process ${holder.pid})`;
      return { detail: `${place} is already used by ${by}`, remedy: `${setPort}, or stop that program` };
    }
    case 'EADDRNOTAVAIL':
    case 'ENOTFOUND': {
      const hosts = flagsOf(places, ({ key }) => /host$/i.test(key) && values[key] === host);
      return {
        detail: `${host} is not an address of this machine`,
        remedy: `set ${hosts === '' ? 'the address' : hosts} to an address of this machine: 127.0.0.1 for local access only, 0.0.0.0 for all interfaces`,
      };
    }
    case 'EACCES':
      return {
        detail: `this user may not listen on ${place}`,
        remedy: `${setPort}, above 1023, or give the program the capability CAP_NET_BIND_SERVICE`,
      };
    default:
      return { detail: `cannot listen on ${place}: ${code}`, remedy: setPort };
  }
}

function flagsOf(places: readonly OptionPlace[], which: (place: OptionPlace) => boolean): string {
  return places
    .filter((place) => place.flag !== null && which(place))
    .map((place) => place.flag)
    .join(' or ');
}
