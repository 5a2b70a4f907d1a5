// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/letters.hpp"

#include <utility>

#include "core/base/printable.hpp"

namespace warren {
// The outlines of ASCII's and Latin-1's letters, so that pictures in pixels don't depend on a machine's fonts. Glyphs
// of U+0020 to U+007E and U+00A0 to U+00FF, apart by blanks: a glyph is its advance and its contours, a contour the
// count of its points and these: TrueType's quadratic curves, 1024 units to the letters' size. Points are steps from
// the one before, y up, y doubled + 1 where the point is on the curve; instead of a count 0 stands before a contour of
// an earlier glyph: the glyph, which of its contours, and the step from it. A number is a digit of base 91 (# to ~
// without the backslash) below 40, else two; steps are doubled, those back are -2 n - 1.
//
// Derived from DejaVu Sans 2.37 with another name, as its licence asks. Copyright (c) 2003 by Bitstream, Inc. All
// Rights Reserved. Bitstream Vera is a trademark of Bitstream, Inc. DejaVu changes are in public domain. Permission is
// hereby granted, free of charge, to any person obtaining a copy of the fonts accompanying this license ("Fonts") and
// associated documentation files (the "Font Software"), to reproduce and distribute the Font Software, including
// without limitation the rights to use, copy, merge, publish, distribute, and/or sell copies of the Font Software, and
// to permit persons to whom the Font Software is furnished to do so, subject to the following conditions: The above
// copyright and trademark notices and this permission notice shall be included in all copies of one or more of the Font
// Software typefaces. The Font Software may be modified, altered, or added to, and in particular the designs of glyphs
// or characters in the Fonts may be modified and additional glyphs or characters may be added to the Fonts, only if the
// fonts are renamed to names not containing either the words "Bitstream" or the word "Vera". This License becomes null
// and void to the extent applicable to Fonts or Font Software that has been modified and is distributed under the
// "Bitstream Vera" names. The Font Software may be sold as part of a larger software package but no copy of one or more
// of the Font Software typefaces may be sold by itself. THE FONT SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY
// KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO ANY WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR
// PURPOSE AND NONINFRINGEMENT OF COPYRIGHT, PATENT, TRADEMARK, OR OTHER RIGHT. IN NO EVENT SHALL BITSTREAM OR THE GNOME
// FOUNDATION BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, INCLUDING ANY GENERAL, SPECIAL, INDIRECT, INCIDENTAL,
// OR CONSEQUENTIAL DAMAGES, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF THE USE OR
// INABILITY TO USE THE FONT SOFTWARE OR FROM OTHER DEALINGS IN THE FONT SOFTWARE.

inline constexpr std::string_view letter_outlines =
    "N0 O)'MzP1Lm$#P/Ll$)MzlDLm$#Xx6RILA$8RK Og'NZlD#VfLK$#Vh'RglD#VfLG$#Vh S~'V*_CMi$KNQqMj$?THktKcS_Mj$KfSaL@$KaS_M~$"
    "#M}NI$KLQqN($#MyNM$KcS_L?$KbSaMk$KaS_LA$KdSaN#$#M{NJ$KOQsN+$#N#NR$KdSa QfER2Q0K_$#Q2Ke'LrKWKeKT#NSKbKzLqKzKl&#TYL|"
    "KCLjNB#Ms#N2L{NcLm<#OiK`$#O_KW)LPK9KMK.#NEKLKKLOK[KV,#S{M)KALuNP#M}#N8M&NqLv>*Q)[P#SXKo9KuLw#LO#LFKnL_*R2W<#T+K|GK"
    "|L}#LU#LPKwLq U:/ZwX~KP#K]Ml#ML#MCK^MpKQ$KQ#K^Mr#MF#MMK]Mn/Zw[mL@#LXOE#Nb#N]LYOAL=$L?#LWOC#N`#NcLZOG/OWj2KN#K_Ml#M"
    "H#MKK^MlKQ$KS#K`Mn#MN#MIK_Mn'YQl}L@$TnmWL?$/OWl}L@#L]OE#N^#NeL[O=L?$L=#LYOC#Nd#N_L]OG SA-P&]9KTLBKPN,#LO#MdLuNqL@$"
    "KY#LHK|KCK}JQY_dP0U}K5LPK=O')M&LZ$.MKKcP2KVMDM[PlM@$L-MoKcLRM(LJL#$M4#MyPX#O<#MEL(OSL$LfK*K|K*M=#Ku#N2L}NsLX$KO#LD"
    "KAKQKB#NUKPKWL?K`K>$Kc#L#L{#LO#KbK7Lo M`#%### N{1QUmfL'OYK{TJ#OZ#O^K~TNL&OZL?$L7OdL3TX#OP#OKL4TPL8Oi N{1LDmfL@$L6O"
    "fL6TN#OJ#OML5TVL5OcL?$L$O[L$TP#Oa#O[L#TL P45U1g#NQNrNRNnK6LdN9O(#RrKk$#RtN9O&K6LfNRNpNQNtK7LfN:N~#RpKl$#RnN:O$ S~/"
    "Twgl#VjPc$#NAPb$#VjLG$#VlPb$#NCPc$#Vl N0)M5P1Lu$#NALCQXK}$KMQZ N]'K`XfPP$#N1PO$ N0'L}P1Ls$#P/Lr$ NC'P<lDLJ$P;pRLI$"
    " Qf/QfiML;#L=Q?#Q@#Q;L>Q;L<$L<#L<Q=#Q>#QAL;QA/Qfl}M?#MOS9#Rv#RmMNS9M>$M@#MLS;#Rp#RwMMS; Qf.MCN?N4$#dXNQL/#N[NPL1Lk"
    "$#hZN4$#N=T#$ Qf@NsN?R@$#N=T|$#N?KnM1NySGK-KqK^LyKIMv#L1#M5LGMrL%$KX#LtK~KsL'#O(KvK`LuK`KS$M-#MYO^#Nn#LVK@N4KTM$<K"
    "1MPPZ QfK$Sd]9L0K5LDNq#Me#OIMuOnM]$KZ#LfKCKeKD#NtKOKYLiKbKh$La#LgMv#Mc#MMLYMrLC$LM$#N3LV$L4#L@M5#M&#M-LCM9L7$KN#L["
    "KAKoKF#NSKpK;LiK;KU$M+#MQO-#NQ#M;L-N< Qf&S)hPP1]'P2$.RNlDME$#`wLu$#N9Lt$#R=Lj$#R?Q{$#Nt QfAL}lDS=$#N9Q8$#R^K'CKSCK"
    "'$M?#MjPZ#O_#OrMqPFMT$KZ#LbK;KcK<#O$KUK^LaKYKh$LL#LkNZ#N##M~LjNRLK$KL#LAKAKNKB Qf/Q~]jL'#L?Na#N)#N,L@N]L($L(#L@N_#"
    "N/#N*L?Nc<VFk`#NYKFKCL9KGKF$Lh#LrPN2PSK7LLLPL]Kh$M%#MKPV#Oc#O^MTPZM&$MH#MTS;#Rp#RFN:SlM`$KG#L:K5 Qf*LHlDU-$#LGPQjP"
    "Lr$P0haRI$ Qf/QfZ/L/#LEMt#MT#MSLFMtL0$L0#LDMz#MR#MULCMv;OO])K{K;L1NJ#MF#NRMCO/M%$M##MCO-#NQ#MCL/NHK}K:L2KALDNq#Me#"
    "O=MNO^M:$M<#MLO`#O@#MfLDNs/Ncd(#M+L0MGL$$K|#L4MI#M.#M-L3MIK{$L##L/MG Qf<M%K<#N[KGKAL<KIKG$Li#LuPP1PYK4LJLQLVKg$M$#"
    "MJPP#Oi#O[MUPaM)$MG#MWS9#Rv#R<N9SjMa$KF#L;K3/QMY2L(#L>N_#N/#N*L=NcL'$L'#L?Na#N)#N,L@N] NC'M5P1Lu$#P/Lt$'M5bsLu$#P3"
    "Lt$ NC#=$###/### S~*['afUuR^UvRU#NUX`Tn#N3XaTn S~'Ly`$Xa$#N9X`$'LyV'Xa$#N=X`$ S~*Lyaf#NWXaTl#N1X`Tl#NWUvRW PT'NsP1"
    "Lk$#P/Lj$DQ%SDL`$#N##LiK3MIKWLMKSLQK5KhK-L]#K]#LTK}L}Kg$KH#LSL*KZL##NdKWKlLcKlKb$LX#M%Nm#N%#L6KBMWKTLKKRLKK(KUJKf*"
    "K.(I(Kr#Kc Un/RyVC#M`L.N,Kx$Kx#L,N2#M_#M^L/N6Ku$Ku#L-N0K<XyOmK6L:L;L.Kc$LK#LvP$#N|#N{LyP,LJ$Kd#L<L6K7L7#MNL.$#ZfL2"
    "K#LDOO#NK#LyK8NcK:LAKcMMMoMYLO$Kw#M&K~KZK{L=LgLOQp#Nj#N(KpP_KhLtKdLoMYLwL>$K~#M=LLKdLEKUM$KyL_MkLoL7$LY#N1MMK{M>K{"
    "M=L#Qn#Nh#NRL(QrKxM>K~MEN<MQL]$Lu#NVNDKxN)KELcKIOY#M<#P>N%Q7M]. R:&R:h$MVZrPZ$+Q#lDM+$PmlBLr$L'S$Q{$L'R~Lt$ R<,O#Z"
    "7#VUN.$LB#L>MQ#M_#M^L=MMLA$,O#hi#TOMp$L4#L2M%#M*#M)L1M%L3$2LilDP8$M-#M?Ni#NI#MSK{N0KwJL6K9LDN}#Mu#NyMTOAM@$PK$ RI="
    "Y)ir#O:KcLaM*L]K}$MD#MTQK#Q(#Q#MUQKME$K~#M+LaKdL^#O2KgL.M0L.L#$N=#NnS`#RK#RNNoSdN>$L&#M3L. S7,O#hi#e+M9$Mz#MfPe#Q6"
    "#Q1MePeMy$,LilDO/$OA#O%RL#R~#S%O&RPO>$O.$ Qa/LilDTy$#N9Rb$#T?RD$#N9RC$#VMRw$#N=U0$ Q&-LilDT$$#N9Qi$#T7Q)$#NAQ($#Z5"
    "Ll$ S=AW|O8#SHN5$#N7PH$#X[KqLFM_LFL?$NG#NtSS#RW#R_NuSSNH$L2#MKL.KlL+#O:KkL]M@LaL+$MT#MXQ;#Q8#Q/MYQ?MU$Kh#LHKG S%/L"
    "ilDLm$#X#RZ$#X%Lm$#lBLl$#Z7RY$#Z5Ll$ Mt'LilDLm$#lBLl$ Mt/LilDLm$#j(#PNLnOvM&$KH$#N?K9$L(#KhMr#Np Qz.LilDLm$#XGQvXI"
    "MI$RbYqS=]'MN$RIZG#ZELl$ Po)LilDLm$#hZRT$#N=Tj$ T<0LilDMt$NiatNiavMt$#lBLf$#hHNlb(Lj$Nlb*#hFLd$ R}-LilDMU$Qrf}#g#L"
    "e$#lBMT$Qqg##f}Ld$ SI/SKiEL|#MHQh#Pl#PcMIQhL}$L}#MEQj#Pf#PmMDQj/SKl}M~#NcSj#RE#R<NbSjM}$N%#NbSl#R?#RFNcSl QC,O#hi#"
    "VvMA$L.#L:Mj#MV#MML9MnL-$.LilDOW$MA#MEOQ#OB#OIMDOQM@$M@$#WgLl$ SI#K*###5VTK4MOP|M8$L|OqD)D#2$N%#NbSl#R?#RFNcSlN&$M"
    "~#NcSj#RE#P:LpR] RF7TTY{K=K%KvMdK;M@LmSRLx$L`S$KDMnL)LiKs$L|$#XKLl$#lDOW$ME#MAO5#O>#M`K}N],O#hi#V9MA$L4#L4MU#MN#MI"
    "L3MQL3$ QdK#VZk?#NrKoKhLlKhKX$LE#LQMC#M0#LcKrLkLHK6KtK.M)KMLwOA#NU#O=MgOMM_$Ke#M4K[K{KX#O0KxL*M1L&Kn$LN#L]MU#M>#M%"
    "L'M=L9K8KuK,M(KWLhNk#N?#NwM[OWM;$Kd#L{KE QK+(lDXJ$#N9PC$#h_Ll$#haPE$ Rm5LRlDLk$#_M#OnLPO1Lc$Lc#LNO3#Oq#_OLk$#`&#P{"
    "MeQ'M_$M_#MgQ)#P~ R:*Q#$PnlDLu$Ohg1Ojg3Ls$PllB Ub0K?lDLm$N$g9N$g;M'$N$g9M~g;Lo$N`lBMD$N#h(N'h&MB$ R</K|lDL{$N]VfNa"
    "VhL{$OoZ=P4[ZLz$O2XUO4XSL|$PJ]) QK,&lDLy$O/X#O)X%L{$PC[c#Z5Ll$#Z7 R<-KplDWK$#MuTxe;U5$#N=W{$#M{Tye=T`$ N{+LPmjO7$#"
    "MeM4$#mGM5$#MaO6$ NC'LJlDP<pRLI$P;pT N{+QImj#sbO6$#McM3$#mIM2$#Mg S~*U)lDPTVjLj$OFS<OFS:Lj$PTVl P4'V&R%#MeV9$#Mg P"
    "4'NZoWM^RjL7$N/Rl QM.R<V|L~#LKLo#M8#LcK|M+Kl$L8#LXOC#NS#KP>V>X^#X[LW$#N?K8LkL[L_L'$LK#LjNk#N/#NgMANkMA$ME$#D#MELEM"
    "^L5$KZ#LWKYKNKR#N;KbKKL_KKKU$M7#M5P* Qd/UQVt#O#LEO[L1$L1#LEOY#N~#O%LFO^L2$L2#LFO`4N_`LK3LiLRLeKv$Lm#MEQ`#PC#PBMDQ`"
    "Ll$Ku#LQLaK2Lj#N9LY$#mjLZ$ Ph=UUc7#NAKJKSL;KSKJ$LS#LdOU#O&#O)LeOQLT$KK#L<KOKKKP#N9KHKALEKAKV$M@#MqQQ#PU#PTMtQQMK$K"
    "O#LDKA Qd4Tk`L#WuLX$#mhLW$#N;K4LgLOL_Kw$Ll#MDQb#PE#PDMEQbLm$Kx#LPLc/MvVt#O%LFO^L2$L2#LHO`#O(#O#LGO[L1$L1#LEOY QO8W"
    "7Wu#LSSs$/NeLoNuLV$Kh#LgKdK^Ke#NIK_KILpKQKe$MP#N#QI#PE#P]MpQbMA$M'#MMP{*U5Y*&MvLCNRL'$L9#LYNH.M} NR7Rwmj#MuLO$K_#K"
    "FL>#Lp#LhMv$#MeMu$#a#LW$#a%LO$#MgLP$#L=#N_LLNBL_$ Qd/TkW0#N{LEOGL3$L3#LCOE#Nz#NuLDOEL4$L4#LFOG@VmM_#PsMBP_MJ$K]#LK"
    "K7KJK4#NSKKKQL@KMKK$LV#LTNg#Nh#LUK4LcLOLcKw$Lp#M@QM#P9#P<MAQQLq$Kx#LPLgK5Ld#N?LX$ Qc7VwYJ#YHLW$#Y>#N&KwN*Kw$L3#LKN"
    "i#N1#XKLY$#mjLZ$#W{K;LmLTLiKp$Lc#LgOn Mb'Lad4LX$#d2LW$'LamjLX$#O_LW$ Mb/Lad4LX$#dZ#O9LANiLU$K>$#N#K+$Kd#KGLe#Mw#KD"
    "$## Q*.LZmjLZ$#_jPXU6M1$Q,V)QEW_M4$PlV[#VYLY$ Mb'LamjLX$#mhLW$ USFV:_KKAM=LaM5K~$LP#L]Oz#OR#YHLW$#Y>#N.KmM~Kq$L-#L"
    "ENi#N1#XKLW$#Y>#N.KoM~Kq$L-#LCNi#N1#XKLY$#d4LZ$#NEK9LmLPLiKv$Kt#LLM; Qc7VwYJ#YHLW$#Y>#N&KwN*Kw$L3#LKNi#N1#XKLY$#d4"
    "LZ$#NEK;LmLTLiKp$Lc#LgOn QK/QMaEL3#LKO^#Nz#N}LJOYL6$L2#LLO`#N|#NwLKOd/QMdmM5#MUQG#P[#PZMTQGM4$M6#MVQI#P^#P]MWQI Qd"
    "4N_N;#WZLY$#mULZ$#N=K3LiLRLeKv$Lm#MEQ`#PC#PBMDQ`Ll$Ku#LQLa#K=### Qd#K?$##4TkN;K4LgLOL_Kw$Ll#MDQb#PE#PDMEQbLm$Kx#LP"
    "LcK5Lh#N?LX$#mSLW$ O45Sn`H@GKDGK&$L;#LEO%#Nf#WRLY$#d4LZ$#NEK3LmL]LiL$$7#K'-?. PJK#TTcO#NIKJKKLGKKKR$L)#L)LF#LG#KzK"
    "`L.L4K:K9BLeKILFMx#MX#M|M<NPLx$KT#LbK?KgK@#NlK`KfLiKfK[$K~#L,LT#LE#L4KaL@LIKHK:@LIKCL7Mr#MF#N*M%NBLm$Kd#LTK9 N}7Nc"
    "k3#QTNe$#MeNd$#Ww#MSKEL:Kn$L_$#MyL^$Lt#LAN*#O0#WyL%$#MgL&$#QV Qc7LNT=#YNLX$#Y@#N$KxN$Kx$L6#LLNc#N3#XULX$#d2LW$#NCK"
    ">LkLOLcKo$Lb#LhOp$QUdm Q7*K7d4Le$NH`6NH`8Le$O2d2M@$ Sj0KQd4LX$M+^iM)^kL{$M+^iM)^kLX$Mid2Lx$M6_hM6_fLx$ Q7/Vwd4N~VQ"
    "O7W6Lx$N/T9N/T7Lx$OAWLNxV?Ly$MpSBMpSD Q73QnLpKJNyL3M7Kw$L1$#M{Kh$KG#KOL0K-MRELIOTclLe$NH^mNH^oLe$ PN-Kld4T4$#N9R1]"
    "7R2$#MmTK$#N;R2]9Qu$ QfHV*Nf#MeK:$M<#LGMn#OL#Om#MrKgM-L/$K6$#MgK7$L0#KhM-#Mo#Oq#OGLHMnM=$K;$#MeK>$L-#KPLN#M]#P##M|"
    "KVMdKgK*KjK1KUM[#M}#P##M`KQLNL.$ NC'O=mz#xVLI$#xX QfHMENfKA$L,#KQLL#Mg#P%#M~KSM^KlK4KkK+KRMf#N##P%#MbKPLLL+$K@$#Mg"
    "K;$M=#LHMl#OF#Oo#MlKhM+L,$K;$#MeK:$L+#KgM+#Mq#Ok#OILGMlM<$K:$ S~A[']Q#NIKeL>LQL&K]$Ki#L1Ku,+($(+2,L;K|KV$KR#LKL:K_"
    "LC#NKKfL@LRL(K^$Kj#L4Ks+))$+)1*L<KzKW$KS#LHL8 N0 O)'P4^ZLl$#P1Lm$)P4RfLl$#Xz9RKLB$7RI Qf*R$MN#^FL1ILCOM#NY#N]LDOQ>"
    "V6c7#NAKFKOL'KOK>,#^TKA+L*KOKCKH#N9K<K9L)K=KF.#PlKa$#PvM6K#MLQ=#P9#P4MMQAM7K$#PvKb$#PtKE)L*K9 Qf?Vak`#NUKFKOL'KKK8"
    "$L3#KoM|#O6#O:Ns$#MaNr$#TlPc$#N=UN$#N?M1$#TnLf$#McLg$#Om#P<LyOxM-$K7#L8K9 QfGTDaELoO4KnM(LnO.IKnGM/#K{#KvJM'JKoLsO"
    "*KmM(LpO,K4KIKoKAK8$K2#KsKCK8KDLnO*KmM*LoO0FKtFM5#Km#K|GM-K#KmLpO0KpM*LoO*K1KGKpKGK;$K7#KrKA/TcXf#M%L9MvKo$Kk#L;Mt"
    "#M$#M+L<M|Kl$Kn#L<N& Qf<WCTYO*$#TWLh$#TYO.$#M:O/$#KaKNN#N5$#M>MM$N'WHL_$NgYyNcY{La$N)WFMM$#M<N3$KNM}#K_O-$ NC'O=ST"
    "#[6LI$#[8'O=k'#[6LI$#[8 P4/Ng`0K:KUK8LR#KV#L6L*MOMAMPK9KWK9LT#KX#L8L/MUK.S`kd#N1KLKGL-KKK2$K]#KgL>#L/#LNLoM,=A12Lu"
    "M/K~Mx#Lh#LVKVM[KXKcK;KbK3Lw#K{#MdLlN8LK$KD#L9K7KRK8#N3KSKIL4KIK3$Kd#KlLH#L9#LqL|M:<@LvM5K{Mv#Lr#LTKWMbKWKaK6KSK4M"
    "%#L-#MELiN*LF$KC#L:K1 P4'Q7mbLk$#N~Lj$'LymbLk$#N~Lj$ Un;Unl4L8#MMLwKhL|KhL{KhP:#M}#MtKgP:KgLxKgL{MLL{L7$L7#MLL}KgL"
    "~KgLyKgP<#Mw#M~KhP<KhL~KhL}MMLy;UnizL##M$LZKZL[KVLZKZOU#ML#MCK[OUKWLWK[L_M%LZL$$L$#M)L]KWLbKYLXKYOS#MJ#MQKZOSKVL^K"
    "VL]M(L]=Y-dT#MDK>K;K{K;K>$L3#LGND#N%#N$LLNDL<$K;#KtK;K?K<#M@K>K5L'K1KB$Lx#M>Ox#O0#O3M?OtLy$KE#L(K1 Or'L,WXR.$#M<R-"
    "$>S[e1#TGL3$#M&K&KvL/L&KV$K{#L7MQ#M*#MQL_M^L]$LV$#,#LTKoLTKq$K8#L'K9K>KB#MFKCK3L2K3KA$LV#LRNH.PXcpL?#KyL&#L;#KzK^L"
    ":KM$Kd#K~Mf#M.#K4 QK*V6bs#NjMqPKMrPK#NjOcSm#LA*QMbs#NjMsPKMtPK#NjOeSm#LA S~)Ly^RXa$#W2LG$#SLVn$ N]#0### Un#Kd$###K"
    "d###,UQc/Ku$#P[Kv$Kl#KQKt#L9#L8KRK|7UYeELP#LNM/#M8#LJKeM#KZB;1K?L:K)L3L*OJLK$K}O4K4LaKDK`K0$K<$#REL9$#]z P4'Lum-Q1"
    "$#MmQ0$ P4/P4j2KJ#KiM##L?#L>KjLwKK$KK#KjLy#LA#L@KiM%2P4l}K;#KrKYK%KZK+KQK'M'#L##MKLWNXL%$L%#LSNR#MV#MQLXN_ S~/Twgl"
    "#S*Pc$#N9Pb$#S*LG$#S,Pb$#N;Pc$#S,#@$#NI O)<MQ[iO7$#M(Q.$#L~EK7K;KmNBQ=#L^#L$KcLDKP$K.#KuKAKBKB#M>KGK3L&K3K5$L0#LNM"
    "K#Lx#M[N3PlK2KY O)K$P@d4KWEK`L{#L?#M;L[MSLQ$K4#KwK'K@K$#M:K/K1KrK-K?$Kh#KtL<#L1#L0KiL8Kg$KP$#LzKY$KY#K[K|#Ku#KpK_K"
    "xKX$J#KaIKJK&#M*KCGK|GK3$L0#LHM/#Ld#L*KTL_ P4'QfoWLg$N/RnL7$ QfDLNSw#mULX$#Yq#MdL*MlL($L4#L4N:#N;#XvLX$#^P#KrGKnG$"
    "+#C;?<#MmJK)KBIF$K>#KNL80LAK,L:L/L:K_$K_#L/L8K$LA#Vf Qf1QQlDOO$#p_L+$#m~L^$#m|L-$#^.LxGM.OK#N[#NcMIO` N0#1##P} P47"
    "Q-$K3KvK/Ls#KZ#LNKsLVKo$K*#KP;K$<#MNCAKGAK)$K5#K7K[#KX#K7K$LPK(Ku O).L<[aLm$#W}M$KJ#M.M-KLL($#ZQLm$#L|P[$ Or#Ke###"
    "/Otl}LR#LoOE#Nj#NiLnOALQ$LS#LpOG#Nh#NkLqOG/OtjJKe#KyN(#MT#MKK|N(Kd$Kd#KxN*#MN#MUKwN* QK*LabsOfSk#L?OeSk#NlMtPMMsPM"
    "*QMbsOdSk#L?OcSk#NlMrPMMqPM UM#Kt###&]XZ;MySgMz$.]B]zLF$#VIL($#L|L'$#N^L/$#N`O,$#M:'Ydl}L@$TlmWL?$ UM#Kt###<Z>M*O7"
    "$#M(Q0$#L~GK7K9KmNBQ=#L^#L$KcLDKP$K.#KsKAKBKB#M>KGK3L$K3K5$L2#LLMK#Lx#M[N3PlK2KY#Kw&## UM#Kn####Kw$###Kw%###Kw&## "
    "PTDP(ZGL_$#M}#LkK0MGKVLOKRLOK6KbK,LZ#K_#LNK~L{Kj$KI#LTL,K[L)#NbKXKnL`KjKa$LW#M$No#N+#L8KCMUKSLMKSLMK+K[K#Kd+K,)K')"
    "Kt#Ki'R6^ZLj$#P1Lk$ R:#D####D$##'Q^uALePCL9$M*PE R:#D####D$##'RsuALX$M(PCL7$ R:#D####D$##*Q7uAL]$LsPCL)$LENKLENIL)"
    "$ R:#D####D$##AR6q1K2K@<;@;.$F#JK^#KV#*Ky$#LiKbM1KS$G#K7AK+K.K3K:;9E91$C#K#Kd#KL#0Kz$$LgKcM/KN$B#K6C R:#D####D$###"
    "Kc#L]N(#Kc#LjN( R:/Sxo?#KxKRLTK:$K:#KRLJ#L##KvKSLNK;$K;#KSLP&R:h$MTZrPT$6PXj:K6KOK8M)#L5#M)L>N*Kp$Kn#LBN(#M(#L*K:M"
    "/K6KNPHj8Lr$L'S$Q{$L'R~Lt$ US3_olD#N9Rb$#T?RF$#N9RE$#VMRw$#N=U0$#S$PC$L?R~Ll$QIlD'S'hyN3[kOY$#[m RI#F###7TH$K3KvK1"
    "Ls#KZ#LNKsLVKq$K(#KP;K&<#MNEAKEAK+$K5#K7K[#KX#K7K$LPK(Ku Qa#H###'Q=uALePCL7$M*PE Qa#H###'RRuALZ$M(PCL9$ Qa#H###*Pu"
    "uAL]$LuPCL+$LENKLENIL+$ Qa#H###'R{taLm$#N~Ll$'N_taLm$#N~Ll$ Mt#K$###'M;uALePCL9$M(PE Mt#K$####L($NW# Mt#K$###*LquA"
    "L]$LuPCL+$LCNKLGNIL)$ Mt#K$####L*$NY##Kc#Q0N( S=0LulDO/$O?#O%RL#R~#S%O$RPO>$O.$#Y{Lj$#MgLk$0O-hi#U4N:$#MeN9$#V=M7$"
    "M|#MdPe#Q6#Q1McPeM{$ R}#K)###ARyq1K4K@:;B;.$F#JK^#KV#*Kw$#LiKdM1KO$G#K9AK+K.K5K:99E93$C#K#Kd#KL#0Kx$$LgKaM/KN$F#K4"
    "C SI#K*####K*$###L+$P,# SI#K*####K*$###L($L*# SI#K*####K*$###L-$P,# SI#K*####K*$##ASGq1K4K@<;@;.$F#JK^#KV#*Ky$#LiK"
    "dM1KQ$G#K9AK+K.K3K:;9C93$C#K#Kd#KL#0Kx$#LgKcM/KN$D#K4C SI#K*####K*$###L*$L(##Kc#KZN( S~/ZBchOVT`OWTWKsM4OXT^OXT[Ks"
    "M6OWTYOVTbKtM6OYT[OYT^ SI-Wnd$RK^0K;KzL@K~K[$L}#MEQj#Pf#M%JNZ-VwfNK6K|LAL(KX$L|#MHQh#Pl#M#K#NaIL';MUOHKHLiKHPD#N+#"
    "RFNcSlN&$K|#M#L6KQL7LDNlK`LSLGNvKGLoKKPB#N)#R<NbSjM}$K{#L~L4KTL5LCNfKaLQ Rm#K0####L'$KK# Rm#K0####L($KK# Rm#K0####"
    "L)$KK# Rm#K0####L*$KK##L*$M}# QK#K4####L($K$# QE0LilDLm$#PCMA$MA#MEOM#OF#OEMDOQM@$M@$#Q}Ll$,O#b{#VrMA$L.#L:Mj#MR#M"
    "QL7MjL/$ Q_K+LZdT#N{M3OGL}$Lq#L{O^%ONL51LGM+#L`#KUK5LBK;KJK5KFLFLsK[M`#Lh#N@M$NTLt$K:#L'K+KBK,#N3KKK5L,K5K;$Kp#KtL"
    "a#LY#KxK6LHK_KyKVKmKZKpKRMQ#LY#MELHNBL8K4*LqL#M%Kk$L##L'M[#ML#dJLY$ QM#K<####K<$##'OOoWMbRjL9$N/Rl QM#K<####K<$##'"
    "RZoWLi$N/RnL9$ QM#K<####K<$##*P<oWL4$M9RnL)$LSO}LSO{L)$ QM#K<####K<$##?Q'ibK4Ki6K#DK#0$F#FL.&LGKw$%MUKbMnKW$G#K;K1"
    "IK>K5Kg7IEI1$G#GL0'LIKx$$MSKaMlKV$F#K:K3 QM#K<####K<$###L*$KFN'#L*$OcN' QM#K<####K<$##/Rim)#K|KRLPK:$K<#KPLN#K{#Kz"
    "KQLNK=$K;#KSLP/T,m)#M+L?N(Km$Km#L?N*#M.#M-L@N&Kn$Kn#L@N$ U[*^KY*$MvLCNRL'$L9#LYNH.M}K(UQ`iKCLPLuLaL$$M)#MMP{#P'#LS"
    "Ss$/NiLmNyLX$Kd#LiKhK`Ki#NIK_KILpKQKe$LE#M<M5KHM6KDM3LxM3L-$L^#LpN_#N;#NgMANkMA$ME$#D#MELEM^L5$KZ#LWKYKNKR#N;KbKKL"
    "_KKKU$L.#LuL_#K<### Ph#K>###7Rc$K1KvK1Ls#KZ#LNKsLVKq$K(#KR;K$<#MNEAKEAK)$K7#K7K[#KX#K7K&LPK&Ku QO#K@####K@$##'P.oW"
    "M`RjL7$N1Rl QO#K@####K@$##'S9oWLg$N-RnL9$ QO#K@####K@$##*PuoWL4$M;RnL)$LSO}LSO{L+$ QO#K@####K@$###L*$6N'#Kc#M@# Mb"
    "'L,oWM`RjL9$N-Rl#KD####KP$NI# Mb'O7oWLi$N1RnL7$#KD####KP$NI# Mb#KD####KP$NI#*LuoWL4$M9RnL+$LSO}LSO{L)$ Mb#KD####KP"
    "$NI##Kc#M&##L*$S*N' QK2Sj_dK,CKRCJ$LG#LWO=#Nr#NaLLOEL4$L0#LNOG#Nd#M=K0Nc=TLd]K|M`KlPs#NE#P.MaQCM($M,#MaQE#P1#P,MYQ"
    "EM#$5#K/-K%*L=NSN)LxBLjM^LYLSO(M)$KzMeN8L~CLdMmL` Qc#KI###?QnibK2Ki:K#BK#.$J#FL.#LGKy$%MUKbMnKU$K##K;K1GK>K3Kg;ICI"
    "/$K##GL0#LIKz$$MSKaMlKT$J#K:K3 QK#KJ####KJ$###LG%:# QK#KJ####KJ$###LH%:# QK#KJ####KJ$###LI%:# QK#KJ####KJ$##?QIibK"
    "4Ki8K#BK#0$H#FL.$LGKy$'MUK`MnKW$I#K;K1IK>K3Kg9IEI/$I#GL0%LIKx$#MSKcMlKT$H#K:K3 QK#KJ####KJ$###L*$K&N'#Kc#MX# S~'R_"
    "dTM9$#P#M8$'R_S<M9$#O{M8$'LyZWXa$#NAX`$ QK-TP]1OuWVK%KIKbKIK=$L2#LLO`#N|#L<6M1-Sf_SK$KOKcKOK6$L7#LGOf#O6#L.5Lw7KZ;"
    "L}N7K.L<K2Ns#M6#P]MWQIM7$KW#L@KbK=KcL*N;K[L?L1NMK1L:K/Nq#M4#PZMTQGM4$KZ#LAKdK8KaL+N9KZL= Qc#KP####KP$###LG%2# Qc#K"
    "P####KP$###LH%2# Qc#KP####KP$###LI%2# Qc#KP####KP$###L*$FN'#Kc#MP# Q7#KT####L@%/# Qd4N_N;#WZLY$#w/LZ$#WsK3LiLRLeKv"
    "$Lm#MEQ`#PC#PBMDQ`Ll$Ku#LQLa#K=### Q7#KT####L*$K:N'#L*$OVN'";

namespace {

constexpr double units = 1024.0;

/// Reads the numbers of a glyph.
struct GlyphReader {
  std::string_view digits;
  bool ended() const { return digits.empty(); }
  int number() {
    constexpr int small = 40;
    const int first = digit();
    return first < small ? first : small + 91 * (first - small) + digit();
  }
  static int step(int number) { return number % 2 == 0 ? number / 2 : -(number / 2) - 1; }
  int digit() {
    const char c = digits.front();
    digits.remove_prefix(1);
    return c - (c > '\\' ? '$' : '#');
  }
};

GlyphReader glyph(std::size_t number) {
  static const std::vector<std::string_view> glyphs = split(letter_outlines, " ");
  return {glyphs[number]};
}

std::size_t glyph_of(char latin1) {
  const auto code = static_cast<unsigned char>(latin1);
  return code < 0x80U ? code - 0x20U : code - 0xa0U + 95U;
}

struct CurvePoint {
  Vec2 at;
  bool on = false;
};
using CurveContour = std::vector<CurvePoint>;

/// In units, y up.
std::vector<CurveContour> contours_of(std::size_t number) {
  std::vector<CurveContour> contours;
  GlyphReader reader = glyph(number);
  reader.number();  // its advance
  const auto step = [&] { return static_cast<double>(GlyphReader::step(reader.number())); };
  while (!reader.ended()) {
    CurveContour contour(static_cast<std::size_t>(reader.number()));
    Vec2 at;
    for (CurvePoint& p : contour) {
      at.x += step();
      const int y = reader.number();
      at.y += GlyphReader::step(y / 2);
      p = {at, y % 2 == 1};
    }
    if (contour.empty()) {
      const std::vector<CurveContour> earlier = contours_of(static_cast<std::size_t>(reader.number()));
      contour = earlier[static_cast<std::size_t>(reader.number())];
      at.x = step();
      at.y = step();
      for (CurvePoint& p : contour) p.at = p.at + at;
    }
    contours.push_back(std::move(contour));
  }
  return contours;
}

/// The contour in chords: between two points off the curve lies one on it, half-way.
std::vector<Vec2> contour_of(const CurveContour& points) {
  constexpr int chords = 4;
  std::vector<Vec2> contour;
  const std::size_t n = points.size();
  const auto middle = [](Vec2 a, Vec2 b) { return 0.5 * (a + b); };
  for (std::size_t i = 0; i < n; ++i) {
    const CurvePoint& here = points[i];
    if (here.on) {
      contour.push_back(here.at);
      continue;
    }
    const CurvePoint& before = points[(i + n - 1) % n];
    const CurvePoint& after = points[(i + 1) % n];
    const Vec2 a = before.on ? before.at : middle(before.at, here.at);
    const Vec2 b = after.on ? after.at : middle(here.at, after.at);
    for (int k = before.on ? 1 : 0; k < chords; ++k) {
      const double t = static_cast<double>(k) / chords;
      contour.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * here.at + t * t * b);
    }
  }
  return contour;
}

/// Cut at the blanks that stand behind one of these letters; none: at all blanks.
std::vector<std::string> parts_between(const std::string& text, std::string_view behind) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    std::string& last = parts.back();
    if (c == ' ' && (behind.empty() || (!last.empty() && behind.find(last.back()) != std::string_view::npos))) {
      parts.emplace_back();
    } else {
      last += c;
    }
  }
  return parts;
}

}  // namespace

std::string latin1_text(std::string_view text) {
  std::string latin1;
  while (!text.empty()) {
    const std::size_t bytes = utf8_bytes(text);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
    unsigned code = '?';
    if (bytes == 1) code = byte(0);
    if (bytes == 2) code = (byte(0) & 0x1fU) << 6 | (byte(1) & 0x3fU);
    const bool known = (code >= 0x20U && code < 0x7fU) || (code >= 0xa0U && code <= 0xffU);
    latin1 += known ? static_cast<char>(code) : '?';
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return latin1;
}

double text_width(std::string_view text, double size) {
  int width = 0;
  for (const char c : latin1_text(text)) width += glyph(glyph_of(c)).number();
  return width * size / units;
}

PolygonSet text_outlines(std::string_view text, double size) {
  PolygonSet outlines;
  double pen = 0.0;
  const double scale = size / units;
  for (const char c : latin1_text(text)) {
    for (CurveContour& contour : contours_of(glyph_of(c))) {
      for (CurvePoint& p : contour) p.at = {pen + scale * p.at.x, -scale * p.at.y};
      outlines.add(contour_of(contour));
    }
    pen += scale * glyph(glyph_of(c)).number();
  }
  return outlines;
}

std::string fitting_text(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::string short_text = text;
  while (!short_text.empty() && text_width(short_text + "...", size) > width) {
    do short_text.pop_back();
    while (!short_text.empty() && utf8_bytes(std::string_view(text).substr(short_text.size())) == 0);
  }
  return short_text + "...";
}

std::string fitting_ends(const std::string& text, double size, double width) {
  const auto inside = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) >> 6) == 2;
  };
  for (std::size_t kept = text.size(); kept > 0; --kept) {
    std::size_t begin = (kept + 1) / 2;
    std::size_t end = text.size() - kept / 2;
    while (inside(begin)) --begin;  // no letter is cut
    while (inside(end)) ++end;
    std::string ends = kept == text.size() ? text : text.substr(0, begin) + "..." + text.substr(end);
    if (text_width(ends, size) <= width) return ends;
  }
  return "...";
}

std::vector<std::string> wrapped_text(const std::string& text, double size, double width) {
  if (text.empty()) return {};
  std::vector<std::string> lines(1);
  const auto add = [&](const std::string& part) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? part : line + ' ' + part;
    if (line.empty() || text_width(longer, size) <= width) {
      line = longer;
    } else {
      lines.push_back(part);
    }
  };
  for (const std::string& part : parts_between(text, ",;")) {
    const auto words = text_width(part, size) <= width ? std::vector{part} : parts_between(part, "");
    for (const std::string& word : words) add(word);
  }
  for (std::string& some : lines) some = fitting_text(some, size, width);
  return lines;
}

}  // namespace warren
