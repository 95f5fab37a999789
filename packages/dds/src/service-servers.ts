/**
 * Which servers a service has, as discovery shows them. rmw_cyclonedds tells a service’s identifier in the user data of
 * its reader and of its writer, so that both are known to belong together (`serviceid=…;`). Other implementations do not:
 * they carry the requests’ identity outside the message, and would read our header as a part of it. Pure.
 */

/** A reader or writer of another participant that is matched with one of ours. */
export interface MatchedEndpoint {
  /** 32 hexadecimal digits. */
  guid: string;
  /** May be empty. */
  userData: string;
}

export interface ServiceServers {
  /** Identifiers of servers that hear our requests and whose replies we hear. */
  whole: ReadonlySet<string>;
  /** Identifiers of servers whose replies we hear. */
  replying: ReadonlySet<string>;
  /** Whether anything hears our requests. */
  isHeard: boolean;
  /** Whose software hears our requests without understanding them; `null` if none does. */
  foreign: string | null;
}

const SERVICE_ID = /(?:^|;)serviceid=([^;]+)/;
/** The first two bytes of a GUID name who wrote the software. Source: DDS Foundation, “RTPS vendor and product IDs”. */
const VENDORS: ReadonlyMap<string, string> = new Map([
  ['0101', 'RTI Connext'],
  ['0103', 'OpenDDS'],
  ['010f', 'Fast DDS'],
  ['0110', 'CycloneDDS'],
  ['0111', 'GurumDDS'],
  ['0112', 'RustDDS'],
]);

/** @param values two for each endpoint: GUID, user data */
export function readMatched(values: readonly string[]): MatchedEndpoint[] {
  const endpoints: MatchedEndpoint[] = [];
  for (let i = 0; i + 1 < values.length; i += 2) {
    const [guid = '', userData = ''] = values.slice(i, i + 2);
    endpoints.push({ guid, userData });
  }
  return endpoints;
}

/** @param readers of requests @param writers of replies */
export function serversOf(
  readers: readonly MatchedEndpoint[],
  writers: readonly MatchedEndpoint[],
): ServiceServers {
  const replying = new Set(writers.flatMap((each) => idOf(each) ?? []));
  const hearing = readers.map(idOf);
  const strange = readers.find((each) => idOf(each) === null);
  return {
    whole: new Set(hearing.filter((id) => id !== null && replying.has(id)) as string[]),
    replying,
    isHeard: readers.length > 0,
    foreign: strange === undefined ? null : (VENDORS.get(strange.guid.slice(0, 4)) ?? 'other software'),
  };
}

function idOf({ userData }: MatchedEndpoint): string | null {
  return SERVICE_ID.exec(userData)?.[1] ?? null;
}
