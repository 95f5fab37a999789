/** An element of the page, whose type is checked. @throws {Error} if the page has none of that type with this id */
export function byId<T extends HTMLElement>(id: string, kind: new () => T): T {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`the page has no <${kind.name}> with id ${id}`);
  return element;
}
