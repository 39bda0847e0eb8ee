"""Fourier blocks of the repeated-averaging scheme of order K around valence N, and their eigenvalues in many digits.
Written as high_orders.txt; needs numpy, mpmath and python-flint. Shares no code with the library: points are folded, refined and smoothed here, in fixed-point numbers of P bits."""
import sys, numpy as np
import flint
from flint import arb, acb, acb_mat, ctx
P = 800
ONE = 1 << P
def block(K, N, k):
    ctx.prec = P + 64
    even = K % 2 == 0
    s = (K - 2) // 2 if even else (K - 3) // 2
    R = s
    # sector sites
    if even:
        R = max(R, 1)
        sites = [(a, b) for r in range(1, R + 1) for a in range(1, r + 1) for b in range(0, r + 1) if max(a, b) == r]
    else:
        sites = [(a, b) for r in range(0, R + 1) for a in range(0, r + 1) for b in range(0, r + 1) if max(a, b) == r]
    centre = even and k == 0
    col = {p: i + int(centre) for i, p in enumerate(sites)}
    if centre: col[(0, 0)] = 0
    n = len(col)
    ph = []
    for j in range(N):
        w = acb(flint.fmpq(2 * ((k * j) % N), N)).exp_pi_i()
        f = lambda x: int((x.mid() * arb(2) ** P).floor().unique_fmpz())
        ph.append((f(w.real), f(w.imag)))
    def fold(i, a, b):
        if even:
            if a == 0 and b == 0: return (0, (0, 0))
            while not (a >= 1 and b >= 0):
                if b < 0: i, a, b = i - 1, -b, a
                else: i, a, b = i + 1, b, -a
            return (i % N, (a, b))
        while not (a >= 0 and b >= 0):
            if b < 0: i, a, b = i - 1, -1 - b, a
            else: i, a, b = i + 1, b, -1 - a
        return (i % N, (a, b))
    Z = np.zeros(n, dtype=object); Z[:] = 0
    def get(net, i, a, b):
        i, p = fold(i, a, b)
        if even and p == (0, 0):
            return net[p] if k == 0 else (Z, Z)
        re, im = net[p]
        if i == 0 or k == 0: return re, im
        c, s_ = ph[i]
        return (re * c - im * s_) >> P, (re * s_ + im * c) >> P
    def comb(net, terms, den):
        re, im = Z.copy(), Z.copy()
        for w, i, a, b in terms:
            x, y = get(net, i, a, b)
            re = re + w * x; im = im + w * y
        return re // den, im // den
    net = {}
    for p, c in col.items():
        v = Z.copy(); v[c] = ONE
        net[p] = (v, Z.copy())
    if even and k != 0: net[(0, 0)] = (Z, Z)
    def todo(r):
        if even:
            l = [(a, b) for a in range(1, r + 1) for b in range(0, r + 1)]
            return l + ([(0, 0)] if k == 0 else [])
        return [(a, b) for a in range(0, r + 1) for b in range(0, r + 1)]
    new = {}
    if even:
        for (A, B) in todo(R + s):
            ta = [(1, A // 2)] if A % 2 == 0 else [(1, A // 2), (1, A // 2 + 1)]
            tb = [(1, B // 2)] if B % 2 == 0 else [(1, B // 2), (1, B // 2 + 1)]
            terms = [(1, 0, a, b) for _, a in ta for _, b in tb]
            new[(A, B)] = comb(net, terms, len(terms))
        if k: new[(0, 0)] = (Z, Z)
        net = new
        for t in range(s):
            new = {}
            for (A, B) in todo(R + s - 1 - t):
                if (A, B) == (0, 0):
                    terms = [((N - 3) * N, 0, 0, 0)] + [(2, j, 1, 0) for j in range(N)] + [(1, j, 1, 1) for j in range(N)]
                    new[(0, 0)] = comb(net, terms, N * N)
                else:
                    terms = [(wx * wy, 0, A + dx, B + dy) for dx, wx in ((-1, 1), (0, 2), (1, 1)) for dy, wy in ((-1, 1), (0, 2), (1, 1))]
                    new[(A, B)] = comb(net, terms, 16)
            if k: new[(0, 0)] = (Z, Z)
            net = new
    else:
        for (A, B) in todo(R + s):
            if (A, B) == (0, 0):
                terms = [(3 * N - 3, 0, 0, 0)] + [(3 if j in (1, N - 1) else 1, j, 0, 0) for j in range(1, N)]
                new[(A, B)] = comb(net, terms, 4 * N)
            else:
                f = lambda X: [(3, X // 2), (1, X // 2 + (1 if X % 2 else -1))]
                new[(A, B)] = comb(net, [(wa * wb, 0, a, b) for wa, a in f(A) for wb, b in f(B)], 16)
        net = new
        for t in range(s):
            new = {}
            for (A, B) in todo(R + s - 1 - t):
                if (A, B) == (0, 0):
                    # three quadrilateral faces (4 points each, sixteenths) and the centroid of the N-gon
                    terms = []
                    for fa, fb in ((0, 0), (-1, 0), (0, -1)):
                        terms += [(N, 0, fa + da, fb + db) for da in (0, 1) for db in (0, 1)]
                    terms += [(4, j, 0, 0) for j in range(N)]
                    new[(A, B)] = comb(net, terms, 16 * N)
                else:
                    new[(A, B)] = comb(net, [(wx * wy, 0, A + dx, B + dy) for dx, wx in ((-1, 1), (0, 2), (1, 1)) for dy, wy in ((-1, 1), (0, 2), (1, 1))], 16)
            net = new
    rows = sorted(col, key=lambda p: col[p])
    sc = arb(2) ** (-P)
    return acb_mat(n, n, [acb(arb(int(net[p][0][j])) * sc, arb(int(net[p][1][j])) * sc) for p in rows for j in range(n)])
def eig(M, prec):
    ctx.prec = prec
    return M.eig(algorithm="approx")
from mpmath import mp, mpf, mpc
mp.dps=120
sets=[(11,3),(11,19),(12,5),(12,14),(12,20),(13,4),(13,15),(14,6),(14,16),(15,7),(15,17),(16,8),(16,18),(17,9),(17,13),(18,10),(19,11),(20,5),(20,12),(21,3),(22,4),(24,3),(32,3)]
out=open('high_orders.txt','w')
out.write("# order valence fourier: eigenvalue [imaginary part]*multiplicity .., by falling modulus\n")
def num(x): return mp.nstr(x,24,min_fixed=0,max_fixed=0) if x else "0"
for K,N in sets:
    for k in sorted({0,1,N//2}) if N<16 or K!=12 else range(N//2+1):
        ev=eig(block(K,N,k),700)
        z=[mpc(mpf(a.real.mid().str(110,radius=False)),mpf(a.imag.mid().str(110,radius=False))) for a in ev]
        z.sort(key=lambda a:(-abs(a),-a.real,-a.imag))
        c=[]
        for v in z:
            for e in c[-6:]:
                if abs(e[0]-v)<mpf(10)**-40: e[1]+=1; break
            else: c.append([v,1])
        def show(v,m):
            t=num(v.real)
            if abs(v.imag)>mpf(10)**-35: t+=("+" if v.imag>0 else "")+num(v.imag)+"i"
            return t+("*%d"%m if m>1 else "")
        out.write("%d %d %d: %s\n"%(K,N,k," ".join(show(*e) for e in c))); out.flush()
print("done")
