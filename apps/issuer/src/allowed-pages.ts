/** The pages that grants may be sent to. */

/** A page's address; one that ends with `/` stands for everything below it. */
export function isAllowedPage(pages: readonly string[], address: string): boolean {
  const { origin, pathname } = new URL(address);
  return pages.some((each) => {
    const page = new URL(each);
    return (
      page.origin === origin &&
      (page.pathname.endsWith('/') ? pathname.startsWith(page.pathname) : pathname === page.pathname)
    );
  });
}
