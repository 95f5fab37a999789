/** The pages that grants may be sent to. */

/** By its exact address, but for the query, in which the page keeps what it shows. */
export function isAllowedPage(pages: readonly string[], address: string): boolean {
  const { origin, pathname } = new URL(address);
  return pages.some((each) => {
    const page = new URL(each);
    return page.origin === origin && page.pathname === pathname;
  });
}
