/** A metric's value; 0 if it has none with these labels yet. @param name with its labels @throws {Error} if there is no such metric */
export async function metricOf(adminUrl: string, name: string): Promise<number> {
  const text = await (await fetch(`${adminUrl}/metrics`)).text();
  // Otherwise a test that expects 0 would pass with any name.
  if (!text.includes(`# HELP ${name.split('{')[0]} `)) throw new Error(`there is no metric ${name}`);
  const line = text.split('\n').find((each) => each.startsWith(`${name} `));
  return line === undefined ? 0 : Number(line.slice(name.length + 1));
}
